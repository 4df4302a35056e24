// SPDX-License-Identifier: BSD-3-Clause
#include "view/shaders.h"

namespace view {

const char* const kMeshVertexShader = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 axis_x;
layout(location = 3) in vec3 axis_y;
layout(location = 4) in vec3 axis_z;
layout(location = 5) in vec3 origin;
layout(location = 6) in vec4 tint;
uniform mat4 clip_from_world;
uniform mat4 shadow_from_world;
uniform vec3 to_sun;
uniform float pixel;  // [m] wide at depth 1
out vec3 position_ws;
out vec3 normal_ws;
out vec3 place_in_shadow;
flat out vec4 color;

void main() {
  mat3 axes = mat3(axis_x, axis_y, axis_z);
  position_ws = axes * position + origin;
  // The cofactors: right for axes of unequal length too.
  normal_ws = mat3(cross(axis_y, axis_z), cross(axis_z, axis_x), cross(axis_x, axis_y)) * normal;
  color = tint;
  gl_Position = clip_from_world * vec4(position_ws, 1);
  // Two pixels nearer to the sun, which nobody sees: at the edge of a triangle what is drawn is the
  // pixel's middle, which may be beside it and below the surface.
  vec3 lifted = position_ws + 2 * pixel * gl_Position.w * to_sun;
  place_in_shadow = (shadow_from_world * vec4(lifted, 1)).xyz;
}
)";

// Light from the sun where no shadow falls, and from the sky and the ground everywhere. Colors are
// squared to be reckoned with, which is near enough to what screens do and costs least where the
// processor draws. What is not asked for is left out before it is compiled: a processor does not
// jump over what a condition leaves out.
const char* const kLitFragmentShader = R"(
in vec3 position_ws;
in vec3 normal_ws;
in vec3 place_in_shadow;
flat in vec4 color;
uniform vec3 eye;
uniform vec3 to_sun;
uniform sampler2DShadow shadow;
out vec4 seen;

float sunshine() {
  if (any(greaterThan(abs(place_in_shadow - 0.5), vec3(0.5)))) return 1.0;
#ifdef SOFT
  vec2 texel = 0.75 / vec2(textureSize(shadow, 0));
  float sum = 0;
  for (int i = 0; i < 4; ++i) {
    vec2 aside = vec2((i & 1) * 2 - 1, (i & 2) - 1) * texel;
    sum += texture(shadow, place_in_shadow + vec3(aside, 0));
  }
  return sum / 4;
#else
  return texture(shadow, place_in_shadow);
#endif
}

void main() {
  vec3 n = normalize(gl_FrontFacing ? normal_ws : -normal_ws);
  vec3 base = color.rgb * color.rgb;
  float sun = max(dot(n, to_sun), 0) * sunshine();
  vec3 sky = mix(vec3(0.26, 0.23, 0.21), vec3(0.50, 0.55, 0.64), 0.5 + 0.5 * n.z);
  vec3 light = sky + 1.05 * sun * vec3(1.0, 0.95, 0.86);
#ifdef GRID
  vec2 off = abs(fract(position_ws.xy + 0.5) - 0.5);
  vec2 width = max(fwidth(position_ws.xy), 0.004);
  vec2 line = 1 - smoothstep(width * 0.7, width * 1.7, off);
  base *= 1 - 0.22 * max(line.x, line.y) * smoothstep(0.3, 0.6, abs(n.z));
  seen = vec4(sqrt(base * light), color.a);
#else
  vec3 half_way = normalize(to_sun + normalize(eye - position_ws));
  float shine = max(dot(n, half_way), 0);
  for (int i = 0; i < 5; ++i) shine *= shine;
  seen = vec4(sqrt(base * light + min(sun, 1) * 0.14 * shine), color.a);
#endif
}
)";

const char* const kFlatFragmentShader = R"(
flat in vec4 color;
out vec4 seen;

void main() { seen = color; }
)";

const char* const kShadowVertexShader = R"(
layout(location = 0) in vec3 position;
layout(location = 2) in vec3 axis_x;
layout(location = 3) in vec3 axis_y;
layout(location = 4) in vec3 axis_z;
layout(location = 5) in vec3 origin;
uniform mat4 clip_from_world;

void main() {
  gl_Position = clip_from_world * vec4(mat3(axis_x, axis_y, axis_z) * position + origin, 1);
}
)";

const char* const kShadowFragmentShader = R"(
void main() {}
)";

const char* const kSkyVertexShader = R"(
out float height;

void main() {
  vec2 corner = vec2((gl_VertexID & 1) * 4 - 1, (gl_VertexID & 2) * 2 - 1);
  height = corner.y * 0.5 + 0.5;
  gl_Position = vec4(corner, 1, 1);
}
)";

const char* const kSkyFragmentShader = R"(
in float height;
out vec4 seen;

void main() { seen = vec4(mix(vec3(0.80, 0.82, 0.85), vec3(0.93, 0.95, 0.97), height), 1); }
)";

}  // namespace view
