"""The work of surfaces.py, in a process of its own. It needs nothing of the compiled library.

MeshFix makes caps and finds triangles that cross. TetGen fills the lumen, then the tissue; both keep the triangles between them.
"""

from .program import answer as answer
