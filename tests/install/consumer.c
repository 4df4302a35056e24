/* SPDX-License-Identifier: BSD-3-Clause */
/* Two overlapping boxes made of triangles, from C: exits 0 if the batch gives them contacts. */
#include <ode_ext/ode_ext.h>
#include <stdio.h>

#ifndef ODE_EXT_VERSION
#error "the version is part of the installed headers"
#endif

enum { kMaxContacts = 8 };

static const dReal kCorners[8 * 4] = {-1, -1, -1, 0, 1, -1, -1, 0, -1, 1, -1, 0, 1, 1, -1, 0,
                                      -1, -1, 1,  0, 1, -1, 1,  0, -1, 1, 1,  0, 1, 1, 1,  0};
static const dTriIndex kTriangles[12 * 3] = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                             2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};

static void near_callback(void* data, dGeomID o1, dGeomID o2) {
  dContactGeom contacts[kMaxContacts];
  *(int*)data += dCollide(o1, o2, kMaxContacts, contacts, sizeof(dContactGeom));
}

int main(void) {
  dInitODE2(0);
  dBatchColliderID collider = dBatchColliderCreate(NULL);
  if (!collider) {
    fprintf(stderr, "%s\n", dBatchColliderGetLastErrorMessage());
    return 1;
  }
  dSpaceID space = dSimpleSpaceCreate(0);
  dTriMeshDataID box = dGeomTriMeshDataCreate();
  dGeomTriMeshDataBuildSimple(box, kCorners, 8, kTriangles, 36);
  dCreateTriMesh(space, box, 0, 0, 0);
  dGeomSetPosition(dCreateTriMesh(space, box, 0, 0, 0), 0.1, 0.2, 1.9);

  int contacts = 0;
  const int result = dBatchColliderSpaceCollide(collider, space, &contacts, near_callback);
  const int pairs = (int)dBatchColliderGetCount(collider, dBatchCounterPairs);
  printf("C, version %s, %s: %d contacts, %d pair in the batch\n", ODE_EXT_VERSION,
         dBatchColliderGetDeviceName(collider), contacts, pairs);

  dSpaceDestroy(space);
  dGeomTriMeshDataDestroy(box);
  dBatchColliderDestroy(collider);
  dCloseODE();
  return result == 1 && contacts > 0 && pairs == 1 ? 0 : 1;
}
