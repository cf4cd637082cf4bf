# %% [markdown]
# # From a scan to a game model
# A mesh of many triangles is simplified, unwrapped onto a torus, gets its detail as a normal map, and
# is looked at. Run it cell by cell, as a notebook (VS Code, Spyder, Jupytext), or as a script:
# `python torus_atlas.py [FOLDER]` writes the pictures there.

# %%
import sys
from pathlib import Path

import numpy as np

import wrapatlas

folder = Path(sys.argv[1] if len(sys.argv) > 1 and Path(sys.argv[1]).is_dir() else ".")


# %% [markdown]
# ## A mesh
# Any arrays will do; `wrapatlas.load("scan.ply")` or `trimesh.load_mesh(...)` as well.
# This one is a torus with bumps.

# %%
def bumpy_torus(rings=240, sides=120):
    u, v = np.meshgrid(
        np.arange(rings) / rings * 2 * np.pi, np.arange(sides) / sides * 2 * np.pi, indexing="ij"
    )
    bumps = 0.03 * np.cos(24 * u) * np.cos(12 * v) + 0.05 * np.sin(3 * u)
    radius = 0.4 + bumps
    out = 1 + radius * np.cos(v)
    positions = np.stack([out * np.cos(u), radius * np.sin(v), out * np.sin(u)], -1).reshape(-1, 3)
    i, j = np.meshgrid(np.arange(rings), np.arange(sides), indexing="ij")
    a, b = i * sides + j, (i + 1) % rings * sides + j
    c, d = (i + 1) % rings * sides + (j + 1) % sides, i * sides + (j + 1) % sides
    quads = np.stack([a, d, c, b], -1).reshape(-1, 4)
    return positions, np.vstack([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


scan = wrapatlas.Mesh(*bumpy_torus())
scan

# %% [markdown]
# ## Fewer triangles, and few charts
# Charts may go on over the border of the atlas: less of it is lost. `wrap="none"` keeps UVs in [0, 1].

# %%
low = wrapatlas.simplify(scan, "3%")
atlas = wrapatlas.unwrap(low, resolution=512, time=1)
inside = wrapatlas.unwrap(low, resolution=512, time=1, wrap="none")
print(f"{atlas.chart_count} charts: {atlas.efficiency:.1%} of the torus in use, "
      f"{inside.efficiency:.1%} without wrapping; {atlas.wraps.any(axis=1).sum()} charts wrap")
atlas.save_image(folder / "atlas.png", 512)
atlas

# %% [markdown]
# The same, drawn twice along each axis: charts that crossed the border are whole.

# %%
tiles = atlas.image(256, tiles=True)
tiles.save(folder / "tiles.png")
tiles

# %% [markdown]
# Every packing was checked by exact triangles before it was returned. Any other atlas can be, too.

# %%
print(wrapatlas.check(atlas, resolution=512, wrap="uv", padding=2))

# %% [markdown]
# ## The detail, as a normal map

# %%
baking = wrapatlas.bake(atlas, scan, ["tangent", "occlusion"], resolution=512, occlusion_rays=16)
baking.image.save(folder / "normals.png")
baking

# %% [markdown]
# ## Side by side: the scan, 3 % of its triangles, and these with the normal map

# %%
view = {"size": 320, "azimuth": 20, "elevation": 35, "framed_as": scan}
pictures = [
    wrapatlas.render(scan, **view),
    wrapatlas.render(atlas, **view),
    wrapatlas.render(atlas, normal_map=baking.image, **view),
]
side_by_side = np.concatenate(pictures, axis=1).view(wrapatlas.Picture)
side_by_side.save(folder / "models.png")
side_by_side

# %% [markdown]
# ## To a file
# glTF says in its samplers that textures repeat; the other formats leave that to whoever reads them.

# %%
atlas.save(folder / "low.glb")
vmapping, faces, uv = atlas.vmapping, atlas.faces, atlas.uv
print(f"{len(vmapping)} vertices, {len(faces)} triangles -> {folder / 'low.glb'}")
