/* SPDX-License-Identifier: BSD-3-Clause */
/* The functions of ODE that the preload stands in front of: INTERPOSED(name). */
INTERPOSED(dInitODE)
INTERPOSED(dInitODE2)
INTERPOSED(dSpaceCollide)
INTERPOSED(dSpaceCollide2)
INTERPOSED(dCollide)
INTERPOSED(dSetColliderOverride)
INTERPOSED(dCreateTriMesh)
INTERPOSED(dGeomDestroy)
INTERPOSED(dGeomTriMeshDataBuildSingle)
INTERPOSED(dGeomTriMeshDataBuildSingle1)
INTERPOSED(dGeomTriMeshDataBuildDouble)
INTERPOSED(dGeomTriMeshDataBuildDouble1)
INTERPOSED(dGeomTriMeshDataBuildSimple)
INTERPOSED(dGeomTriMeshDataBuildSimple1)
INTERPOSED(dGeomTriMeshDataUpdate)
INTERPOSED(dGeomTriMeshDataDestroy)
#undef INTERPOSED
