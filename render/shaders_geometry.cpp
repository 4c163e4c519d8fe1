#include "render/shaders.h"

namespace lather::render::shaders {
namespace {

const std::string kVersion = "#version 330 core\n";

// Both the point pass and its shadow: primitives are point sprites, or quads (two triangles an instance) when
// a sprite would be larger than the driver allows.
const std::string kPointCorner = R"(
uniform bool quads;
vec2 corner() {
  if (!quads) return vec2(0.0);
  return vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
}
)";

}  // namespace

Stages mesh() {
  return {kVersion + R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 clip_from_object, camera_from_object;
out vec3 camera_normal;
void main() {
  gl_Position = clip_from_object * vec4(position, 1.0);
  camera_normal = mat3(camera_from_object) * normal;
}
)",
          kVersion + R"(
in vec3 camera_normal;
uniform vec3 color;
layout(location = 0) out vec4 out_albedo;
layout(location = 1) out vec4 out_normal;
void main() {
  out_albedo = vec4(color, 0.75);
  out_normal = vec4(normalize(camera_normal) * 0.5 + 0.5, 1.0);
}
)"};
}

Stages ground() {
  return {kVersion + R"(
layout(location = 0) in vec3 position;
uniform mat4 clip_from_world;
out vec3 world;
void main() {
  world = position;
  gl_Position = clip_from_world * vec4(position, 1.0);
}
)",
          kVersion + R"(
in vec3 world;
uniform vec3 color, normal, origin;
uniform float cell, kind;
uniform bool flat_scene;
layout(location = 0) out vec4 out_albedo;
layout(location = 1) out vec4 out_normal;
void main() {
  vec2 at = ((flat_scene ? world.xy : world.xz) - (flat_scene ? origin.xy : origin.xz)) / cell;
  vec2 width = max(fwidth(at), 1e-6);
  // A checker filtered over the pixel: the product of two filtered square waves, which fades out far away.
  vec2 wave = clamp((abs(fract(at * 0.5) - 0.5) - 0.25) / (0.5 * width), -1.0, 1.0);
  float checker = wave.x * wave.y * clamp(1.5 - max(width.x, width.y), 0.0, 1.0);
  out_albedo = vec4(color * (1.0 + 0.022 * checker), kind);
  out_normal = vec4(normal * 0.5 + 0.5, 1.0);
}
)"};
}

Stages points() {
  return {kVersion + kPointCorner + R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 color;
layout(location = 2) in vec4 surface;  // normal of the body that the points make up, and how much it is one
uniform mat4 camera_from_world;
uniform vec4 projection;  // the elements 00, 11, 22 and 23 of the projection
uniform bool orthographic;
uniform vec2 size;        // of the buffer, px
uniform float radius;     // m
flat out vec3 center;     // camera space
flat out float drawn_radius;
flat out vec3 point_color;
flat out vec4 body;  // normal in camera space and its weight
void main() {
  center = (camera_from_world * vec4(position, 1.0)).xyz;
  float distance = orthographic ? 1.0 : max(-center.z, 1e-6);
  float px_per_m = 0.5 * size.y * projection.y / distance;
  // Never smaller than a sample: thin sheets must not fall through between samples.
  drawn_radius = max(radius, 0.75 / px_per_m);
  point_color = color.rgb;
  // Spheres of a pixel or two are noise: there the body is lit; large ones keep more of their own shape.
  float weight = surface.w * mix(0.9, 0.6, smoothstep(2.0, 24.0, drawn_radius * px_per_m));
  body = vec4(mat3(camera_from_world) * surface.xyz, weight);
  // A sphere off the axis is an ellipse; this circle holds it.
  float stretch = orthographic ? 1.0 : length(center) / max(distance - drawn_radius, 0.1 * distance);
  float half_size = drawn_radius * px_per_m * stretch + 1.0;
  gl_PointSize = 2.0 * half_size;
  float w = orthographic ? 1.0 : -center.z;
  float z = orthographic ? projection.z * center.z + projection.w : projection.z * center.z + projection.w;
  gl_Position = vec4(projection.xy * center.xy, z, w);
  gl_Position.xy += corner() * half_size * 2.0 / size * w;
}
)",
          kVersion + R"(
flat in vec3 center;
flat in float drawn_radius;
flat in vec3 point_color;
flat in vec4 body;
uniform vec4 projection;
uniform bool orthographic;
uniform vec2 size;
layout(location = 0) out vec4 out_albedo;
layout(location = 1) out vec4 out_normal;
void main() {
  // The ray through this sample meets the sphere; measured from the point of the ray next to the centre, for
  // |ray|^2 - r^2 would lose all digits in float.
  vec2 ndc = gl_FragCoord.xy * 2.0 / size - 1.0;
  vec2 slope = ndc / projection.xy;
  vec3 origin = orthographic ? vec3(slope, 0.0) : vec3(0.0);
  vec3 ray = orthographic ? vec3(0.0, 0.0, -1.0) : vec3(slope, -1.0);
  float inverse_square = 1.0 / dot(ray, ray);
  float nearest = dot(center - origin, ray) * inverse_square;
  vec3 miss = origin + nearest * ray - center;
  float half_chord_square = drawn_radius * drawn_radius - dot(miss, miss);
  if (half_chord_square < 0.0) discard;
  float back = sqrt(half_chord_square * inverse_square);
  vec3 normal = (miss - back * ray) / drawn_radius;
  float z = origin.z + (nearest - back) * ray.z;
  float ndc_z = orthographic ? projection.z * z + projection.w : (projection.z * z + projection.w) / -z;
  gl_FragDepth = ndc_z * 0.5 + 0.5;
  out_albedo = vec4(point_color, 1.0);
  out_normal = vec4(normalize(mix(normal, body.xyz, body.w)) * 0.5 + 0.5, 1.0);
}
)"};
}

Stages mesh_shadow() {
  return {kVersion + R"(
layout(location = 0) in vec3 position;
uniform mat4 clip_from_object;
void main() { gl_Position = clip_from_object * vec4(position, 1.0); }
)",
          kVersion + "void main() {}\n"};
}

Stages point_shadow() {
  return {kVersion + kPointCorner + R"(
layout(location = 0) in vec3 position;
uniform mat4 clip_from_world;
uniform float half_size;  // px
uniform vec2 size;        // of the buffer, px
void main() {
  gl_PointSize = 2.0 * half_size;
  gl_Position = clip_from_world * vec4(position, 1.0);
  gl_Position.xy += corner() * half_size * 2.0 / size;
}
)",
          // Squares at the centres' depth: a point is in its own shadow only behind its centre, and the gaps
          // between neighbours let no light through.
          kVersion + "void main() {}\n"};
}

}  // namespace lather::render::shaders
