// SPDX-License-Identifier: BSD-3-Clause
// A program that collides two meshes by a function of its own, which it sets after its first pass:
// how often that is asked, and what it gives.
#include <ode/ode.h>

#include <cstdio>

namespace {

int asked = 0;

int collide_by_itself(dGeomID, dGeomID, int, dContactGeom*, int) {
  ++asked;
  return 0;
}

void set_collider() { dSetColliderOverride(dTriMeshClass, dTriMeshClass, &collide_by_itself); }

void collide(void* contacts, dGeomID a, dGeomID b) {
  dContactGeom found[8];
  *static_cast<int*>(contacts) += dCollide(a, b, 8, found, sizeof(dContactGeom));
}

void pass(dSpaceID space) {
  int contacts = 0;
  asked = 0;
  dSpaceCollide(space, &contacts, &collide);
  std::printf("asked %d times, contacts %d\n", asked, contacts);
}

}  // namespace

int main() {
  dInitODE2(0);
  // A tetrahedron in another.
  const float corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const dTriIndex triangles[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  const dTriMeshDataID data = dGeomTriMeshDataCreate();
  dGeomTriMeshDataBuildSingle(data, corners, 3 * sizeof(float), 4, triangles, 12,
                              3 * sizeof(dTriIndex));
  const dSpaceID space = dSimpleSpaceCreate(nullptr);
  dCreateTriMesh(space, data, nullptr, nullptr, nullptr);
  dGeomSetPosition(dCreateTriMesh(space, data, nullptr, nullptr, nullptr), 0.1, 0.2, 0.1);
  pass(space);
  set_collider();
  pass(space);
  dInitODE2(0);  // once more, which changes nothing
  pass(space);
  dSpaceDestroy(space);
  dGeomTriMeshDataDestroy(data);
  dCloseODE();
}
