// SPDX-License-Identifier: BSD-3-Clause
// The programs that run on the graphics card, GLSL 3.30.
#pragma once

namespace view {

// Meshes, many at a time: attributes 0 and 1 of the vertex, 2 to 6 of the instance.
extern const char* const kMeshVertexShader;
extern const char* const kMeshFragmentShader;
// The same, depth alone, as the sun sees it.
extern const char* const kShadowVertexShader;
extern const char* const kShadowFragmentShader;
// What is behind everything.
extern const char* const kSkyVertexShader;
extern const char* const kSkyFragmentShader;

}  // namespace view
