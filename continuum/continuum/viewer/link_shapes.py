"""Shapes of the links of an arm; equal shapes are combined into one with all links that have it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import trimesh
from numpy.typing import NDArray
from yourdfpy import URDF, Geometry, Link, Material

from continuum.arrays import Array
from continuum.cable_colours import Colour
from continuum.errors import InvalidValueError

_ROUND = 20
"""Number of corners of a cylinder."""


@dataclass(frozen=True)
class Shape:
    """One mesh shared by several links.

    Attributes:
        vertices: (n_vertices, 3) [m] in the link's frame.
        faces: (n_faces, 3).
        links: numbers of the links that have it, (n,).
        colours: colour on each of these links, (n, 3), red, green and blue from 0 to 1.
    """

    vertices: NDArray[np.float32]
    faces: NDArray[np.uint32]
    links: NDArray[np.int64]
    colours: Array


def link_shapes(description: URDF, links: Sequence[str]) -> list[Shape]:
    """Return the shapes of a description of cylinders and spheres; the parts of a link in one colour are one mesh."""
    materials = {material.name: material for material in description.robot.materials}
    found: dict[bytes, tuple[trimesh.Trimesh, list[int], list[Colour]]] = {}
    for number, link in enumerate(links):
        for colour, mesh in _meshes(description.link_map[link], materials):
            key = np.round(mesh.vertices, 9).tobytes()
            _, on, colours = found.setdefault(key, (mesh, [], []))
            on.append(number)
            colours.append(colour)
    return [
        Shape(mesh.vertices.astype(np.float32), mesh.faces.astype(np.uint32), np.array(on), np.array(colours))
        for mesh, on, colours in found.values()
    ]


def _meshes(link: Link, materials: Mapping[str, Material]) -> Iterator[tuple[Colour, trimesh.Trimesh]]:
    by_colour: dict[Colour, list[trimesh.Trimesh]] = {}
    for visual in link.visuals:
        mesh = _mesh(visual.geometry)
        if visual.origin is not None:
            mesh.apply_transform(visual.origin)
        by_colour.setdefault(_colour(materials, visual.material.name), []).append(mesh)
    for colour, meshes in by_colour.items():
        merged: trimesh.Trimesh = trimesh.util.concatenate(meshes)  # type: ignore[assignment]
        yield colour, merged


def _mesh(geometry: Geometry) -> trimesh.Trimesh:
    mesh: trimesh.Trimesh
    if geometry.cylinder is not None:
        cylinder = geometry.cylinder
        mesh = trimesh.creation.cylinder(radius=cylinder.radius, height=cylinder.length, sections=_ROUND)
    elif geometry.sphere is not None:
        mesh = trimesh.creation.icosphere(subdivisions=2, radius=geometry.sphere.radius)
    else:
        raise InvalidValueError("geometry of a link", geometry, "a cylinder or a sphere")
    return mesh


def _colour(materials: Mapping[str, Material], name: str) -> Colour:
    red, green, blue, _ = materials[name].color.rgba.tolist()
    return red, green, blue
