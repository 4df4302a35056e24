#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A program of panda3d, whose wheel has an ODE of its own in single precision: meshes in random
poses, and beside them a world of boxes and spheres that falls on a plane and on a mesh.

Prints which pairs of meshes collide, what the boxes and spheres did to the last bit, and figures."""

import argparse
import hashlib
import math
import random
import time

from panda3d.core import (Geom, GeomNode, GeomTriangles, GeomVertexData, GeomVertexFormat,
                          GeomVertexWriter, NodePath, Quat)
from panda3d.ode import (OdeBody, OdeBoxGeom, OdeHashSpace, OdeJointGroup, OdeMass, OdePlaneGeom,
                         OdeSphereGeom, OdeTriMeshData, OdeTriMeshGeom, OdeUtil, OdeWorld)


def torus():
    around, across = 12, 8
    vertices, triangles = [], []
    for i in range(around):
        for j in range(across):
            u, v = 2 * math.pi * i / around, 2 * math.pi * j / across
            r = 1 + 0.4 * math.cos(v)
            vertices.append((r * math.cos(u), r * math.sin(u), 0.4 * math.sin(v)))
            a, b = i * across + j, (i + 1) % around * across + j
            c = (i + 1) % around * across + (j + 1) % across
            d = i * across + (j + 1) % across
            triangles += [(a, b, c), (a, c, d)]
    return vertices, triangles


def cube(edge):
    vertices = [tuple(edge / 2 * (1 if i >> k & 1 else -1) for k in range(3)) for i in range(8)]
    faces = ((0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6))
    return vertices, [t for a, b, c, d in faces for t in ((a, b, c), (a, c, d))]


def mesh_data(vertices, triangles):
    data = GeomVertexData("mesh", GeomVertexFormat.get_v3(), Geom.UH_static)
    writer = GeomVertexWriter(data, "vertex")
    for vertex in vertices:
        writer.add_data3(*vertex)
    primitive = GeomTriangles(Geom.UH_static)
    for triangle in triangles:
        primitive.add_vertices(*triangle)
    geom = Geom(data)
    geom.add_primitive(primitive)
    node = GeomNode("mesh")
    node.add_geom(geom)
    return OdeTriMeshData(NodePath(node), False)


def contacts_of(entry):
    contacts = []
    for contact in entry.get_contact_geoms():
        contacts.append((*contact.get_pos(), *contact.get_normal(), contact.get_depth()))
    return contacts


def random_pose(geom, generator, extent):
    geom.set_position(*(generator.uniform(0, extent) for _ in range(3)))
    rotation = Quat(*(generator.gauss(0, 1) for _ in range(4)))
    rotation.normalize()
    geom.set_quaternion(rotation)


def collide_meshes(passes, bodies):
    """Random poses, pass by pass; prints each pair."""
    space, data = OdeHashSpace(), mesh_data(*torus())
    geoms = [OdeTriMeshGeom(space, data) for _ in range(bodies)]
    number = {geom.get_id().this: i for i, geom in enumerate(geoms)}
    generator, digest = random.Random(1), hashlib.sha256()
    pairs = colliding = count = 0
    start = time.perf_counter()
    for step in range(passes):
        for geom in geoms:
            random_pose(geom, generator, 4)
        met = []

        def near(_, first, second):
            met.append((number[first.get_id().this], number[second.get_id().this],
                        contacts_of(OdeUtil.collide(first, second, 16))))

        space.collide(None, near)
        for a, b, contacts in met:
            print(f"pair {step}: {a} and {b} {'collide' if contacts else 'do not'}")
            digest.update(repr(contacts).encode())
            pairs, colliding, count = pairs + 1, colliding + bool(contacts), count + len(contacts)
    seconds = time.perf_counter() - start
    print(f"figures: {pairs} pairs of meshes, {colliding} collide, {count} contacts in "
          f"{seconds:.3f} s, hash {digest.hexdigest()[:16]}")


def cube_on_cube():
    space, data = OdeHashSpace(), mesh_data(*cube(1))
    lower, upper = (OdeTriMeshGeom(space, data) for _ in range(2))
    turned = Quat()
    turned.set_hpr((45, 0, 0))
    upper.set_position(0, 0, 0.99)
    upper.set_quaternion(turned)
    contacts = contacts_of(OdeUtil.collide(upper, lower, 16))
    print(f"figures: cube on cube, 0.010 deep: {len(contacts)} contacts, the deepest "
          f"{max(contact[6] for contact in contacts):.3f}")


def fall(steps):
    """Boxes and spheres on a plane and a mesh of their own: no pair of meshes."""
    world, space, group = OdeWorld(), OdeHashSpace(), OdeJointGroup()
    world.set_gravity(0, 0, -9.81)
    world.init_surface_table(1)
    world.set_surface_entry(0, 0, 50, 0, 9.1, 0.9, 0.00001, 0, 0.002)
    space.set_auto_collide_world(world)
    space.set_auto_collide_joint_group(group)
    plane = OdePlaneGeom(space, 0, 0, 1, 0)
    hill = OdeTriMeshGeom(space, mesh_data(*cube(2)))
    bodies, geoms = [], [plane, hill]
    for i in range(12):
        body, mass = OdeBody(world), OdeMass()
        mass.set_sphere(500, 0.25)
        body.set_mass(mass)
        body.set_position(0.3 * (i % 4) - 0.5, 0.4 * (i // 4) - 0.4, 1.6 + 0.6 * i)
        geom = OdeSphereGeom(space, 0.25) if i % 2 else OdeBoxGeom(space, 0.4, 0.4, 0.4)
        geom.set_body(body)
        bodies.append(body)
        geoms.append(geom)
    for _ in range(steps):
        space.auto_collide()
        world.quick_step(0.01)
        group.empty()
    for i, body in enumerate(bodies):
        place = [*body.get_position(), *body.get_quaternion(), *body.get_linear_vel()]
        print(f"state: body {i} at", *(value.hex() for value in place))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--passes", type=int, default=10, help="of random poses")
    parser.add_argument("--bodies", type=int, default=14, help="with a mesh each")
    parser.add_argument("--steps", type=int, default=200, help="of the boxes and spheres")
    options = parser.parse_args()
    cube_on_cube()
    collide_meshes(options.passes, options.bodies)
    fall(options.steps)


if __name__ == "__main__":
    main()
