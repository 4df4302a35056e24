// SPDX-License-Identifier: BSD-3-Clause
// The functions of ODE that this library calls. The preload links no ODE: it takes them from the
// one that it finds in the program. One that is missing here does not link.
//   ODE_FUNCTION(name)          an ODE without it is left alone
//   ODE_FUNCTION_OR(name, own)  own is called in its place
#ifndef ODE_FUNCTION_OR
#define ODE_FUNCTION_OR(name, own) ODE_FUNCTION(name)
#endif

ODE_FUNCTION(dCheckConfiguration)
ODE_FUNCTION(dCollide)
ODE_FUNCTION(dCreateTriMesh)
ODE_FUNCTION(dGeomDestroy)
ODE_FUNCTION(dGeomGetAABB)
ODE_FUNCTION(dGeomGetBody)
ODE_FUNCTION(dGeomGetClass)
ODE_FUNCTION(dGeomGetPosition)
ODE_FUNCTION(dGeomGetRotation)
ODE_FUNCTION(dGeomIsSpace)
ODE_FUNCTION(dGeomTransformGetGeom)
ODE_FUNCTION(dGeomTriMeshDataCreate)
ODE_FUNCTION(dGeomTriMeshDataDestroy)
ODE_FUNCTION(dGeomTriMeshGetCallback)
ODE_FUNCTION(dGeomTriMeshGetData)
ODE_FUNCTION(dGeomTriMeshGetTriangle)
ODE_FUNCTION(dGeomTriMeshGetTriangleCount)
ODE_FUNCTION(dMessage)
ODE_FUNCTION(dSetColliderOverride)
ODE_FUNCTION(dSpaceCollide)
ODE_FUNCTION(dSpaceCollide2)
ODE_FUNCTION(dSpaceGetGeom)
ODE_FUNCTION(dSpaceGetNumGeoms)
ODE_FUNCTION_OR(dGeomTriMeshDataBuildDouble, build_nothing)
ODE_FUNCTION_OR(dGeomTriMeshDataBuildSingle, build_nothing)
ODE_FUNCTION_OR(dGeomTriMeshGetTriMergeCallback, no_merge_callback)
ODE_FUNCTION_OR(_Z11dCollideTTLP6dxGeomS0_iP12dContactGeomi, no_contacts)

#undef ODE_FUNCTION
#undef ODE_FUNCTION_OR
