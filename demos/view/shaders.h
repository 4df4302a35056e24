// SPDX-License-Identifier: BSD-3-Clause
// The programs that run on the graphics card, GLSL 3.30, without the line that says so.
#pragma once

namespace view {

// Meshes, many at a time: attributes 0 and 1 of the vertex, 2 to 6 of the instance.
extern const char* const kMeshVertexShader;
// In sun and shadow: SOFT, with a soft edge; GRID, with lines every meter.
extern const char* const kLitFragmentShader;
// The color as it is.
extern const char* const kFlatFragmentShader;
// The same, depth alone, as the sun sees it.
extern const char* const kShadowVertexShader;
extern const char* const kShadowFragmentShader;
// What is behind everything.
extern const char* const kSkyVertexShader;
extern const char* const kSkyFragmentShader;

}  // namespace view
