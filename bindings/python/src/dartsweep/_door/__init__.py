"""Readers of meshes. Each gives a Mesh, which knows nothing of the library that read it; meshes.py makes environments of them."""
