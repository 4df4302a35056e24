/* SPDX-License-Identifier: BSD-3-Clause */
/* What blocks of code in the documentation that are no whole program are compiled within: the names
   that a reader takes for granted. */
#include <ode_ext/ode_ext.h>
#include <stdio.h>

extern dWorldID world;
extern dSpaceID space;
extern dJointGroupID joints;
extern dBatchColliderID collider;
extern dGeomID a, b, c, o1, o2;
extern dTriMeshDataID mesh;
extern float* vertices;
extern int vertex_count;
extern void* data;
void near_callback(void* data, dGeomID o1, dGeomID o2);
void use_contact(const dContactGeom* contact);
void move_vertices(float* vertices, int vertex_count);
int was_there_last_step(dGeomID o1, dGeomID o2, dBatchContactId id);
void play_sound_at(const dReal* position);

/* One function for each document: its blocks follow one another, as they are read. */
void blocks(void);
void blocks(void) { /* HERE */
}
