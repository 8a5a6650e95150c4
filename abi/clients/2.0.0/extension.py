"""Tests the extension: extension.py MODULE"""
import array
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(sys.argv[1]).parent))
import client

POINTS = array.array("d", [x for z in range(3) for y in range(2) for x in (0, y, z, 1, y, z)])
CELLS = array.array("q", [0, 1, 3, 2, 4, 5, 7, 6, 4, 5, 7, 6, 8, 9, 11, 10])

assert client.version() > 0
boxes = client.create(POINTS, CELLS)
assert client.count(boxes) == (2, 11)
for environment in (boxes, client.load(client.save(boxes))):
    assert client.cast(environment, (0.25, 0.5, 0.25), (0.75, 0.5, 0.5))[:2] == (1, 1.0)
    assert client.cast(environment, (0.25, 0.5, 0.25), (0.25, 0.5, 4.25)) == (2, 0.4375, (0.0, 0.0, -1.0))
for call, status in ((lambda: client.create(POINTS, CELLS[:8] + array.array("q", [99] * 8)), "INDEX_OUT_OF_RANGE"),
                     (lambda: client.load(b"nothing"), "TRUNCATED")):
    try:
        call()
    except RuntimeError as error:
        assert str(error).startswith("DSW_STATUS_" + status), error
    else:
        raise AssertionError(status)
print("the extension runs")
