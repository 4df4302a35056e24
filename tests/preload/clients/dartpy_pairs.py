#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""A program of dartpy, a Python module that brings DART and Debian's ODE: meshes in random poses, and
a cube on a cube. Prints which pairs collide, and figures."""

import argparse
import math
import pathlib
import random
import tempfile
import time

import dartpy

ROBOT = """<robot name="{name}"><link name="body">
<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
<collision><geometry><mesh filename="file://{mesh}"/></geometry></collision>
</link></robot>"""
CUBE = "".join("v %g %g %g\n" % tuple(0.5 if i >> k & 1 else -0.5 for k in range(3))
               for i in range(8))
CUBE += "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n"


def torus(around=12, across=8):
    text = ""
    for i in range(around):
        for j in range(across):
            u, v = 2 * math.pi * i / around, 2 * math.pi * j / across
            r = 1 + 0.4 * math.cos(v)
            text += f"v {r * math.cos(u)} {r * math.sin(u)} {0.4 * math.sin(v)}\n"
    for i in range(around):
        for j in range(across):
            def at(a, b):
                return a % around * across + b % across + 1
            text += f"f {at(i, j)} {at(i + 1, j)} {at(i + 1, j + 1)} {at(i, j + 1)}\n"
    return text


class Scene:
    def __init__(self, directory, mesh, count):
        path = pathlib.Path(directory, f"mesh{len(mesh)}.obj")
        path.write_text(mesh)
        self.bodies = []
        self.group = dartpy.collision.OdeCollisionDetector().createCollisionGroup()
        for i in range(count):
            robot = path.with_suffix(f".{i}.urdf")
            robot.write_text(ROBOT.format(name=f"body{i}", mesh=path))
            body = dartpy.utils.DartLoader().parseSkeleton(f"file://{robot}")
            self.bodies.append(body)
            self.group.addShapeFramesOf(body.getBodyNode(0))

    def collide(self):
        option = dartpy.collision.CollisionOption(True, 1000000)
        result = dartpy.collision.CollisionResult()
        start = time.perf_counter()
        self.group.collide(option, result)
        return result, time.perf_counter() - start


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--passes", type=int, default=6, help="of random poses")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as directory:
        cubes = Scene(directory, CUBE, 2)
        cubes.bodies[0].setPositions([0] * 6)
        cubes.bodies[1].setPositions([0, 0, math.pi / 4, 0, 0, 0.99])
        contacts = cubes.collide()[0].getContacts()
        print(f"figures: cube on cube, 0.010 deep: {len(contacts)} contacts, the deepest "
              f"{max(contact.penetrationDepth for contact in contacts):.3f}")

        # Which two a contact is of dartpy does not tell, so a scene is two bodies.
        scene, generator = Scene(directory, torus(), 2), random.Random(1)
        colliding = count = seconds = 0
        pairs = 100 * options.passes
        for i in range(pairs):
            for body in scene.bodies:
                turn = [generator.uniform(-math.pi, math.pi) for _ in range(3)]
                body.setPositions(turn + [generator.uniform(0, 2.4) for _ in range(3)])
            result, took = scene.collide()
            print(f"pair {i}", "collides" if result.isCollision() else "does not")
            colliding, count = colliding + result.isCollision(), count + result.getNumContacts()
            seconds += took
        print(f"figures: {pairs} pairs of meshes, {colliding} collide, {count} contacts in "
              f"{seconds:.3f} s")


if __name__ == "__main__":
    main()
