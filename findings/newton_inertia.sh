#!/bin/sh
# Newton and the moments of inertia of thin links in metres.
# One would guess that a rod with a density has links with the moments of inertia of their shapes.
# What happens: a link of a cord 1 mm thick has 7e-11 kg m2 across its axis and 3e-12 along it. `finalize` makes both 1e-6, with one warning
# that names no factor: the link turns 14,000 and 300,000 times too slowly. With ModelBuilder.inertia_absolute_tolerance = 1e-20 they stay.
# Who meets it: everybody who simulates threads, catheters or thin cables in metres, the unit of Newton's examples.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --no-compile newton==1.8.0 numpy==2.4.6
cd "$folder"
venv/bin/python - <<'PY' 2>/dev/null
import numpy as np
import warp as wp

wp.config.quiet = True
import newton

print("newton", newton.__version__)


def moments(tolerance):
    builder = newton.ModelBuilder(gravity=(0.0, 0.0, 0.0))
    builder.default_shape_cfg.density = 6000.0
    points = 5e-3 * np.arange(4)[:, None] * [0.0, 0.0, 1.0]
    bodies, _ = builder.add_rod(rod=newton.Rod(points, radius=0.5e-3), stretch_stiffness=1e3, bend_stiffness=3e-5, bend_damping=3e-6)
    if tolerance is not None:
        builder.inertia_absolute_tolerance = tolerance
    link = np.array(builder.body_inertia[bodies[1]], float).reshape(3, 3).diagonal()
    return link, builder.finalize(device="cpu").body_inertia.numpy()[bodies[1]].diagonal()


link, made = moments(None)
print("of the link:", link, "in the model:", made)
_, kept = moments(1e-20)
print("with inertia_absolute_tolerance = 1e-20:", kept)
assert (made / link)[0] > 1e4 and (made / link)[2] > 1e5, "they are kept now"
assert np.allclose(kept, link, rtol=1e-5)
PY
