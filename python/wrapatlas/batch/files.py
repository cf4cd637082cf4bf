"""Files by path or URL (fsspec), and those that a model names: materials, pictures, buffers."""

from __future__ import annotations

import contextlib
import errno
import importlib
import json
import mmap
import os
import posixpath
import re
import shutil
from typing import Any, Dict, Iterator, List, Optional, Tuple
from urllib.parse import unquote

from .errors import BatchError, UsageError

fsspec: Any = importlib.import_module("fsspec")  # comes with Dask; it has no types

# Whichever a file system gives of these changes when a file does.
MARKS = ("size", "mtime", "etag", "ETag", "LastModified", "last_modified", "updated", "md5Hash", "created")
PICTURE_LINE = re.compile(r"^\s*(?:map_\w+|bump|disp|decal|norm|refl)\s+(.+?)\s*$", re.M | re.I)
PICTURE_OPTION = re.compile(r"^-\w+\s+(?:on|off|[rgbmlz]|[-+]?[.\d]\S*|\w+)\s+(?:[-+]?[.\d]\S*\s+)*")
MOST_REFERENCES = 10_000


def is_local(url: str) -> bool:
    return "://" not in url or url.startswith(("file://", "local://"))


def local_path(url: str) -> str:
    return os.path.abspath(url.split("://", 1)[1] if "://" in url else url)


def file_system(url: str) -> Tuple[Any, str]:
    """The file system of a URL, and the path on it. UsageError where there is none for it."""
    with told(url):
        system, path = fsspec.core.url_to_fs(url)
    return system, path


@contextlib.contextmanager
def told(url: str) -> Iterator[None]:
    """What the library of a file system raises, of any kind, as a UsageError that names the URL."""
    try:
        yield
    except BatchError:
        raise
    except Exception as error:
        why = isinstance(error, OSError) and error.strerror or f"{type(error).__name__}: {error}"
        raise UsageError(f"{url}: {why}") from error


def join(folder: str, name: str) -> str:
    """`name` as seen from `folder`; itself, if it is absolute or a URL."""
    if "://" in name or os.path.isabs(name):
        return name
    if "://" not in folder:
        return os.path.join(folder, name)
    scheme, path = folder.split("://", 1)
    return f"{scheme}://{posixpath.normpath(posixpath.join(path, name))}"


def parent(url: str) -> str:
    return url.rsplit("/", 1)[0] if "://" in url else os.path.dirname(os.path.abspath(url))


def mark(url: str) -> Optional[str]:
    """What differs as soon as the file does: its size and time. None: there is no such file."""
    try:
        if is_local(url):
            stat = os.stat(local_path(url))
            return f"{stat.st_size} {stat.st_mtime_ns}"
        system, path = file_system(url)
        facts: Dict[str, Any] = system.info(path)
        return " ".join(str(facts[name]) for name in MARKS if name in facts)
    except (FileNotFoundError, NotADirectoryError):
        return None


def picture_names(text: str) -> List[str]:
    """The pictures that an .mtl names, options like `-bm 0.5` before the name left out."""
    names = []
    for found in PICTURE_LINE.finditer(text):
        name = found.group(1)
        while name.startswith("-"):
            shorter = PICTURE_OPTION.sub("", name, count=1)
            if shorter == name:
                break
            name = shorter
        names.append(name)
    return names


def find_lines(path: str, pattern: bytes) -> List[str]:
    """What the group of `pattern` matches in a file that may be large."""
    if os.path.getsize(path) == 0:
        return []
    with open(path, "rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as content:
        found = re.finditer(pattern, content)
        return [m.group(1).decode("utf-8", "replace").strip() for m in found][:MOST_REFERENCES]


def named_in(path: str) -> List[str]:
    """The files that a local model or .mtl names, as written there; none if it cannot be read: what
    is wrong with it is for the command to say."""
    ending = os.path.splitext(path)[1].lower()
    names: List[str] = []
    try:
        if ending == ".obj":
            names = find_lines(path, rb"(?m)^[ \t]*mtllib[ \t]+([^\r\n]+)")
        elif ending == ".mtl":
            with open(path, encoding="utf-8", errors="replace") as file:
                names = picture_names(file.read())
        elif ending == ".ply":
            with open(path, "rb") as binary:
                head = binary.read(65536).decode("latin-1")
            names = re.findall(r"(?m)^comment TextureFile ([^\r\n]+)", head)
        elif ending == ".gltf":
            with open(path, encoding="utf-8") as file:
                scene = json.load(file)
            parts = [*scene.get("buffers", []), *scene.get("images", [])]
            uris = [part["uri"] for part in parts if isinstance(part.get("uri"), str)]
            names = [unquote(uri) for uri in uris if not uri.startswith("data:")]
    except (OSError, ValueError, AttributeError, TypeError, KeyError):
        return []
    names = [name.strip().replace("\\", "/") for name in names]
    usable = [n for n in names if n and "://" not in n and "\0" not in n and not os.path.isabs(n)]
    return list(dict.fromkeys(usable))[:MOST_REFERENCES]


class Input:
    """A file of an asset, and all files that it names: local ones where they are, others fetched.

    `path`   where the command can read it
    `marks`  URL → mark of each file, as it was before the command read it
    `beside` name as written in the model → local path, for names of files that are there
    """

    def __init__(self, url: str, scratch: str) -> None:
        self.marks: Dict[str, Optional[str]] = {}
        self.beside: Dict[str, str] = {}
        self._url = url
        self._local = is_local(url)
        # Names may begin with ../: as many folders above the copy, so that they stay in `scratch`.
        self._home = os.path.join(scratch, *(["up"] * 8))
        self.path = self._take(os.path.basename(local_path(url)) if self._local else url.rsplit("/", 1)[1], url)
        if not os.path.exists(self.path):
            raise FileNotFoundError(errno.ENOENT, "no such file", url)
        self._follow(self.path, "")

    def _follow(self, path: str, folder: str) -> None:
        for name in named_in(path):
            beside = posixpath.normpath(posixpath.join(folder, name))
            if beside in self.beside or beside.startswith("../" * 9):
                continue
            there = self._take(beside, join(parent(self._url), beside))
            if os.path.isfile(there):
                self.beside[beside] = there
                if name.lower().endswith(".mtl"):
                    self._follow(there, posixpath.dirname(beside))

    def _take(self, name: str, url: str) -> str:
        self.marks[url] = mark(url)
        if self._local:
            return local_path(url)
        copy = os.path.normpath(os.path.join(self._home, name))
        if self.marks[url] is not None:
            os.makedirs(os.path.dirname(copy), exist_ok=True)
            system, path = file_system(url)
            system.get_file(path, copy)
        return copy


def complete(folder: str, inputs: List[Input]) -> None:
    """Copies what the models in `folder` name and is not there, from beside the inputs."""
    known: Dict[str, str] = {}
    for one in inputs:
        known.update(one.beside)
    for root, _, names in os.walk(folder):
        for model in sorted(names):
            within = os.path.relpath(root, folder).replace(os.sep, "/")
            open_files = [(os.path.join(root, model), within)]
            while open_files:
                path, where = open_files.pop()
                for name in named_in(path):
                    target = posixpath.normpath(posixpath.join(where, name))
                    source = known.get(target)
                    copy = os.path.join(folder, target)
                    if target.startswith("..") or source is None or os.path.lexists(copy):
                        continue
                    os.makedirs(os.path.dirname(copy), exist_ok=True)
                    shutil.copyfile(source, copy)
                    open_files.append((copy, posixpath.dirname(target)))
