/* SPDX-License-Identifier: BSD-3-Clause */
/* An L-shaped mesh falls onto another one: plain ODE but for the lines with a +. Copy freely. */
#include <ode/ode.h>
#include <ode_ext/ode_ext.h> /* + */
#include <stdio.h>

static dWorldID world;

/* The near callback stays what it was: dCollide answers for meshes too. */
static void near_callback(void* joints, dGeomID g1, dGeomID g2) {
  dContact contact[16] = {0};
  int count = dCollide(g1, g2, 16, &contact[0].geom, sizeof contact[0]);
  for (int i = 0; i < count; ++i) {
    contact[i].surface.mode = dContactApprox1; /* or mu is a force */
    contact[i].surface.mu = 0.5;
    dJointID joint = dJointCreateContact(world, joints, &contact[i]);
    dJointAttach(joint, dGeomGetBody(g1), dGeomGetBody(g2));
  }
}

int main(void) {
  /* An L around its centre of mass, counter-clockwise seen from outside; x, y, z in metres. */
  static const float v[36] = {-.15f, -.15f, -.2f, .35f,  -.15f, -.2f, .35f,  -.15f, -.1f,
                              -.05f, -.15f, -.1f, -.05f, -.15f, .4f,  -.15f, -.15f, .4f,
                              -.15f, .15f,  -.2f, .35f,  .15f,  -.2f, .35f,  .15f,  -.1f,
                              -.05f, .15f,  -.1f, -.05f, .15f,  .4f,  -.15f, .15f,  .4f};
  static const dTriIndex t[60] = {0, 1,  2, 0, 2,  3,  0, 3,  4,  0, 4,  5, 6, 8, 7,
                                  6, 9,  8, 6, 10, 9,  6, 11, 10, 0, 6,  7, 0, 7, 1,
                                  1, 7,  8, 1, 8,  2,  2, 8,  9,  2, 9,  3, 3, 9, 10,
                                  3, 10, 4, 4, 10, 11, 4, 11, 5,  5, 11, 6, 5, 6, 0};
  dInitODE2(0);
  world = dWorldCreate();
  dJointGroupID joints = dJointGroupCreate(0);
  dSpaceID space = dSimpleSpaceCreate(0);
  dWorldSetGravity(world, 0, 0, -9.81);
  dBatchColliderID collider = dBatchColliderCreate(NULL); /* + */
  if (!collider) printf("without a device: %s\n", dBatchColliderGetLastErrorMessage());
  dTriMeshDataID mesh = dGeomTriMeshDataCreate();
  dGeomTriMeshDataBuildSingle(mesh, v, 3 * sizeof v[0], 12, t, 60, 3 * sizeof t[0]);
  dCreatePlane(space, 0, 0, 1, 0);
  dBodyID bodies[2];
  for (int i = 0; i < 2; ++i) {
    dGeomID geom = dCreateTriMesh(space, mesh, 0, 0, 0);
    dMass mass;
    dMassSetTrimesh(&mass, 500, geom);
    dMassTranslate(&mass, -mass.c[0], -mass.c[1], -mass.c[2]); /* ODE wants it exact */
    dBodySetMass(bodies[i] = dBodyCreate(world), &mass);
    dGeomSetBody(geom, bodies[i]);
    dBodySetPosition(bodies[i], 0.11 * i, 0, 0.3 + 0.7 * i);
  }
  for (int step = 0; step <= 60; ++step) {
    const dReal *low = dBodyGetPosition(bodies[0]), *high = dBodyGetPosition(bodies[1]);
    if (step % 15 == 0) printf("%.2f s: %.3f m and %.3f m up\n", step / 60.0, low[2], high[2]);
    dBatchColliderSpaceCollide(collider, space, joints, &near_callback); /* + was dSpaceCollide */
    dWorldQuickStep(world, 1 / 60.0);
    dJointGroupEmpty(joints);
  }
  dBatchColliderDestroy(collider); /* + */
  dCloseODE();
}
