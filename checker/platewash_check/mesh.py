"""The vertices of mesh files: STL and OBJ."""

from pathlib import Path

import numpy as np
from scipy.spatial import ConvexHull, QhullError

from .schema import expect

TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")])


def vertices(name, folder, scale):
    """The scaled vertices of a mesh, each once in the order of the file [m]."""
    path = found(name, folder)
    raw = path.read_bytes()
    kind, exact = path.suffix.lower(), raw[80:84] == np.uint32(max(len(raw) - 84, 0) // 50).tobytes() and (len(raw) - 84) % 50 == 0
    expect(kind in (".stl", ".obj"), name, "an STL or OBJ file", kind)
    if kind == ".stl" and (exact or not raw.lstrip().startswith(b"solid")):
        expect(exact, name, "as many triangles as the file states", f"{len(raw)} bytes")
        points = np.frombuffer(raw, TRIANGLE, offset=84)["corners"].astype(float).reshape(-1, 3)
    else:
        word = b"vertex" if kind == ".stl" else b"v"
        lines = [line.split() for line in raw.splitlines()]
        try:
            points = np.array([[float(x) for x in line[1:4]] for line in lines if line[:1] == [word]]).reshape(-1, 3)
        except ValueError as error:
            expect(False, name, "three numbers for each vertex", str(error))
    once = {point.tobytes(): point for point in reversed(points)}
    points = np.array([once[key] for key in dict.fromkeys(point.tobytes() for point in points)]).reshape(-1, 3) * scale
    expect(len(points) >= 4 and np.isfinite(points).all(), name, "four finite vertices or more", len(points))
    return points


def found(name, folder):
    """The file of a mesh: `file://`, `package://NAME/...` in a folder NAME beside or above the description, or relative to it."""
    places = [folder / name]
    if name.startswith("package://"):
        places = [above / name[10:] for above in (folder, *folder.parents)]
    elif name.startswith("file://"):
        places = [Path(name[7:])]
    place = next((place for place in places if place.is_file()), None)
    expect(place is not None, "URDF", "the file of each mesh", name)
    return place


def corners(points):
    """The vertices of the convex hull; all points of a flat one. What Qhull's rounding leaves out is far below that allowed for distances."""
    try:
        return points[ConvexHull(points).vertices]
    except QhullError:
        return points
