"""What an arm's links look like: equal shapes together, each with the places where it stands."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import trimesh
from numpy.typing import NDArray
from yourdfpy import URDF

from continuum.arrays import Array

_ROUND = 20
"""Corners of a cylinder."""


@dataclass(frozen=True)
class Shape:
    """One mesh that stands on several links.

    Attributes:
        vertices: (n_vertices, 3) [m] in the link's frame.
        faces: (n_faces, 3).
        links: numbers of the links that it stands on, (n,).
        colours: one for each of them, (n, 3), red, green and blue from 0 to 1.
    """

    vertices: NDArray[np.float32]
    faces: NDArray[np.uint32]
    links: NDArray[np.int64]
    colours: Array


def link_shapes(description: URDF, links: Sequence[str]) -> list[Shape]:
    """The shapes of a description of cylinders and spheres; of each link what has one colour is one mesh."""
    found: dict[bytes, tuple[trimesh.Trimesh, list[int], list[tuple[float, ...]]]] = {}
    for number, link in enumerate(links):
        for colour, mesh in _meshes(description, link):
            key = np.round(mesh.vertices, 9).tobytes()
            _, on, colours = found.setdefault(key, (mesh, [], []))
            on.append(number)
            colours.append(colour)
    return [
        Shape(mesh.vertices.astype(np.float32), mesh.faces.astype(np.uint32), np.array(on), np.array(colours))
        for mesh, on, colours in found.values()
    ]


def _meshes(description: URDF, link: str) -> Iterator[tuple[tuple[float, ...], trimesh.Trimesh]]:
    by_colour: dict[tuple[float, ...], list[trimesh.Trimesh]] = {}
    for visual in description.link_map[link].visuals:
        mesh = _mesh(visual.geometry)
        if visual.origin is not None:
            mesh.apply_transform(visual.origin)
        by_colour.setdefault(_colour(description, visual.material), []).append(mesh)
    for colour, meshes in by_colour.items():
        yield colour, trimesh.util.concatenate(meshes)


def _mesh(geometry: object) -> trimesh.Trimesh:
    if geometry.cylinder is not None:
        cylinder = geometry.cylinder
        return trimesh.creation.cylinder(radius=cylinder.radius, height=cylinder.length, sections=_ROUND)
    return trimesh.creation.icosphere(subdivisions=2, radius=geometry.sphere.radius)


def _colour(description: URDF, material: object) -> tuple[float, ...]:
    named = description.material_map.get(material.name, material) if hasattr(description, "material_map") else material
    named = next((one for one in description.robot.materials if one.name == material.name), named)
    return tuple(float(part) for part in named.color.rgba[:3])
