"""The summary as one HTML file that needs no other."""

from __future__ import annotations

import base64
import os
from html import escape
from typing import Any, Dict, Iterable, List, Optional, Tuple

from .files import file_system, is_local, join, local_path
from .output import asset_folder
from .store import Store

MOST_FAILURES = 1000
MOST_PICTURES = 48
LARGEST_PICTURE = 64 * 1024
STYLE = """body{font:15px/1.5 system-ui,sans-serif;margin:2em auto;max-width:70em;padding:0 1em;color:#222}
table{border-collapse:collapse;width:100%}td,th{padding:.2em .6em;text-align:left;vertical-align:top;
border-bottom:1px solid #ddd;overflow-wrap:anywhere}.count{font-size:1.6em;margin-right:1.5em}
.bad{color:#b00020}figure{display:inline-block;margin:0 1em 1em 0;vertical-align:top}
figure.small{width:128px;font-size:12px;overflow-wrap:anywhere}img{width:128px;background:#eee}
pre{white-space:pre-wrap;font-size:12px}svg text{font:11px sans-serif}"""


class Histogram:
    """Counts in equal steps from 0, the step doubled as values need it: one pass, any number."""

    BARS = 40

    def __init__(self, step: float) -> None:
        self.step = step
        self.counts = [0] * self.BARS

    def add(self, value: float) -> None:
        while value >= self.step * self.BARS:
            pairs = [self.counts[i] + self.counts[i + 1] for i in range(0, self.BARS, 2)]
            self.counts = pairs + [0] * (self.BARS - len(pairs))
            self.step *= 2
        self.counts[max(0, int(value / self.step))] += 1

    def svg(self, title: str, unit: str) -> str:
        last = max((i for i, count in enumerate(self.counts) if count), default=-1)
        if last < 0:
            return ""
        shown, most, wide = self.counts[:last + 1], max(self.counts), 400 / (last + 1)
        bars = "".join(
            f'<rect x="{i * wide:.1f}" y="{100 - 100 * n / most:.1f}" width="{max(wide - 1, 1):.1f}" '
            f'height="{100 * n / most:.1f}"><title>{n}</title></rect>' for i, n in enumerate(shown))
        return (f'<figure><figcaption>{escape(title)}</figcaption><svg width="400" height="120" fill="#46a">'
                f'{bars}<text y="115" fill="#222">0</text><text y="115" x="400" text-anchor="end" '
                f'fill="#222">{self.step * (last + 1):g}{escape(unit)}</text></svg></figure>')


def write_page(store: Store, folder: str, out: str, told: List[Tuple[str, str]]) -> str:
    """Writes index.html into `folder`; `told` are words about the batch and what they name."""
    efficiency, seconds, memory = Histogram(0.025), Histogram(0.01), Histogram(1.0)
    for row in store.rows():
        if row["state"] == "done":
            seconds.add(row["seconds"] or 0.0)
            memory.add(row["peak_mb"] or 0.0)
            if row["efficiency"] is not None:
                efficiency.add(row["efficiency"])
    counts = store.counts()
    parts = ['<!doctype html><html lang="en"><meta charset="utf-8"><title>wrapatlas batch</title>',
             f"<style>{STYLE}</style><h1>wrapatlas batch</h1><p>"]
    for state in ("failed", "done", "not reached"):
        bad = " bad" if state == "failed" and counts.get(state) else ""
        if state != "not reached" or counts.get(state):
            parts.append(f'<span class="count{bad}">{counts.get(state, 0)} {state}</span>')
    parts.append("</p><table>")
    parts += [f"<tr><th>{escape(word)}</th><td>{escape(value)}</td></tr>" for word, value in told]
    parts.append("</table>")
    parts += failures(store.select("failed", MOST_FAILURES), counts.get("failed", 0))
    parts.append("<h2>Distributions</h2>")
    parts += [efficiency.svg("Efficiency: share of the atlas in use", ""),
              seconds.svg("Seconds an asset", " s"), memory.svg("Peak memory", " MB")]
    parts += pictures(store.select("done", MOST_PICTURES), out)
    path = os.path.join(folder, "index.html")
    with open(path + ".tmp", "w", encoding="utf-8") as file:
        file.write("\n".join(parts) + "\n")
    os.replace(path + ".tmp", path)
    return path


def failures(rows: List[Dict[str, Any]], count: int) -> Iterable[str]:
    if not rows:
        return
    yield "<h2>Failed</h2><table><tr><th>asset</th><th>line</th><th>why</th></tr>"
    for row in rows:
        why = escape(row["reason"])
        if row["log"]:
            why = f"<details><summary>{why}</summary><pre>{escape(row['log'])}</pre></details>"
        yield f"<tr><td>{escape(row['name'])}</td><td>{row['line']}</td><td>{why}</td></tr>"
    yield "</table>"
    if count > len(rows):
        yield f"<p>{count - len(rows)} more are in results.csv.</p>"


def pictures(rows: List[Dict[str, Any]], out: str) -> List[str]:
    shown = []
    for row in rows:
        name = next((name for name in (row["files"] or "").split(" | ") if name.endswith(".png")), "")
        content = small_file(join(asset_folder(out, row["name"]), name)) if name else None
        if content:
            code = base64.b64encode(content).decode("ascii")
            shown.append(f'<figure class="small"><img alt="" src="data:image/png;base64,{code}">'
                         f"<figcaption>{escape(row['name'])}</figcaption></figure>")
    return ["<h2>The first atlases</h2>", *shown] if shown else []


def small_file(url: str) -> Optional[bytes]:
    try:
        if is_local(url):
            if os.path.getsize(local_path(url)) > LARGEST_PICTURE:
                return None
            with open(local_path(url), "rb") as file:
                return file.read()
        system, path = file_system(url)
        return bytes(system.cat_file(path)) if system.size(path) <= LARGEST_PICTURE else None
    except OSError:
        return None
