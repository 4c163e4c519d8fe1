#include "render/shaders.h"

namespace lather::render::shaders {
namespace {

const std::string kVersion = "#version 330 core\n";

// One triangle that covers the screen; no vertex buffer.
const std::string kScreen = kVersion + R"(
void main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0); }
)";

// Kinds of surface in the alpha of the albedo buffer, see shaders_geometry.cpp.
const std::string kCommon = R"(
uniform vec4 projection;  // the elements 00, 11, 22 and 23 of the projection
uniform bool orthographic;
uniform vec2 size;  // of the picture, px
bool is_background(float kind) { return kind < 0.1; }
bool is_floor(float kind) { return kind > 0.1 && kind < 0.4; }
bool is_backdrop(float kind) { return kind > 0.4 && kind < 0.6; }
bool is_point(float kind) { return kind > 0.9; }
float camera_z(float depth) {
  float ndc = 2.0 * depth - 1.0;
  return orthographic ? (ndc - projection.w) / projection.z : -projection.w / (ndc + projection.z);
}
vec3 camera_position(vec2 pixel, float z) {
  vec2 slope = (pixel * 2.0 / size - 1.0) / projection.xy;
  return orthographic ? vec3(slope, z) : vec3(slope * -z, z);
}
float px_per_m(float z) { return 0.5 * size.y * projection.y / (orthographic ? 1.0 : -z); }
)";

}  // namespace

Stages occlusion() {
  return {kScreen, kVersion + kCommon + R"(
uniform sampler2D albedo_map, normal_map, depth_map;
uniform int samples;
uniform vec2 reach;     // m, of the two scales: contact and shape
uniform float radius;   // of points, m
out float out_open;
float kind_at(ivec2 q) { return texelFetch(albedo_map, q, 0).a; }
// McGuire, Mara, Luebke 2012, "Scalable ambient obscurance", eq. 6, with their spiral of samples.
float obscurance(vec2 pixel, vec3 here, vec3 normal, float bias, float r, float turn) {
  const int kSamples = 11;
  float r_px = min(r * px_per_m(here.z), 0.25 * size.y);
  if (r_px < 1.0) return 0.0;
  float sum = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    float along = (float(i) + 0.5) / float(kSamples);
    float angle = along * 6.2831853 * 4.0 + turn;
    vec2 at = clamp(pixel + vec2(cos(angle), sin(angle)) * along * r_px, vec2(0.5), size - 0.5);
    ivec2 q = ivec2(at) * samples + samples / 2;
    float kind = kind_at(q);
    if (is_background(kind) || is_backdrop(kind)) continue;
    vec3 v = camera_position(floor(at) + 0.5, camera_z(texelFetch(depth_map, q, 0).r)) - here;
    float vv = dot(v, v);
    float f = max(1.0 - vv / (r * r), 0.0);
    sum += f * f * f * max((dot(v, normal) - bias) * r / (vv + 1e-4 * r * r), 0.0);
  }
  return sum / float(kSamples);
}
void main() {
  ivec2 p = ivec2(gl_FragCoord.xy);
  ivec2 q = p * samples + samples / 2;
  float kind = kind_at(q);
  out_open = 1.0;
  if (is_background(kind) || is_backdrop(kind)) return;
  vec3 here = camera_position(vec2(p) + 0.5, camera_z(texelFetch(depth_map, q, 0).r));
  vec3 normal = normalize(texelFetch(normal_map, q, 0).xyz * 2.0 - 1.0);
  // Spheres do not occlude the ones beside them, only what the surface that they make up can: the rest is noise.
  float bias = is_point(kind) ? 1.2 * radius : 0.0;
  float turn = float((p.x & 3) * 4 + (p.y & 3)) * (6.2831853 / 16.0);
  float shut = 1.5 * obscurance(gl_FragCoord.xy, here, normal, bias + 0.02 * reach.x, reach.x, turn) +
               3.6 * obscurance(gl_FragCoord.xy, here, normal, bias + 0.02 * reach.y, reach.y, turn);
  out_open = max(0.0, 1.0 - shut);
}
)"};
}

Stages blur_occlusion() {
  return {kScreen, kVersion + kCommon + R"(
uniform sampler2D open_map, depth_map;
uniform int samples;
uniform float reach;
out float out_open;
float z_at(ivec2 p) { return camera_z(texelFetch(depth_map, p * samples + samples / 2, 0).r); }
void main() {
  ivec2 p = ivec2(gl_FragCoord.xy);
  float z = z_at(p);
  float sum = 0.0, weights = 0.0;
  // 4 x 4: the period of the samples' turn.
  for (int j = -1; j <= 2; ++j)
    for (int i = -1; i <= 2; ++i) {
      ivec2 q = clamp(p + ivec2(i, j), ivec2(0), ivec2(size) - 1);
      float weight = 1e-3 + max(0.0, 1.0 - abs(z_at(q) - z) / reach);
      sum += weight * texelFetch(open_map, q, 0).r;
      weights += weight;
    }
  out_open = sum / weights;
}
)"};
}

Stages composite() {
  return {kScreen, kVersion + kCommon + R"(
uniform sampler2D albedo_map, normal_map, depth_map, open_map;
uniform sampler2DShadow shadow_map;
uniform int samples;
uniform bool shadows;
uniform mat4 shadow_from_camera;  // to texture coordinates and depth
uniform float shadow_texel;       // of the shadow map, as a fraction of its side
uniform float shadow_offset;      // m, along the normal
uniform float radius;             // of points, m
uniform vec3 key, fill, rim, up;  // unit, towards the lights and the sky, camera space
uniform vec3 floor_center;        // camera space
uniform float floor_fade;         // m: the floor is gone at this distance
uniform vec3 background;          // sRGB
out vec4 out_color;

vec3 linear(vec3 s) { return mix(s / 12.92, pow((s + 0.055) / 1.055, vec3(2.4)), step(0.04045, s)); }
vec3 srgb(vec3 l) { return mix(l * 12.92, 1.055 * pow(l, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, l)); }

// Straight up to 0.5, then a shoulder that nears 1 and never reaches it: whites keep their shape, colours their hue.
vec3 tone(vec3 c) {
  vec3 over = max(c - 0.5, 0.0);
  return min(c, 0.5) + 0.5 * (1.0 - exp(-over / 0.5));
}
vec3 backdrop(vec2 pixel) {
  float height = pixel.y / size.y;
  vec2 side = pixel / size - 0.5;
  return linear(background) * mix(0.80, 1.06, smoothstep(0.0, 1.0, height)) * (1.0 - 0.22 * dot(side, side));
}
float lit(vec3 here, vec3 normal, float offset) {
  if (!shadows) return 1.0;
  vec4 at = shadow_from_camera * vec4(here + normal * offset, 1.0);
  if (any(lessThan(at.xyz, vec3(0.0))) || any(greaterThan(at.xyz, vec3(1.0)))) return 1.0;
  const vec2 kTaps[8] = vec2[](vec2(0.53, 0.11), vec2(-0.29, 0.45), vec2(-0.47, -0.38), vec2(0.2, -0.6),
                               vec2(0.93, -0.36), vec2(0.4, 0.9), vec2(-0.98, 0.2), vec2(-0.3, -0.95));
  float sum = 0.0;
  for (int i = 0; i < 8; ++i) sum += texture(shadow_map, vec3(at.xy + kTaps[i] * 2.2 * shadow_texel, at.z));
  return sum / 8.0;
}
vec3 shade(ivec2 q, vec2 pixel, float open) {
  vec4 albedo = texelFetch(albedo_map, q, 0);
  vec3 behind = backdrop(pixel);
  if (is_background(albedo.a)) return behind;
  vec3 base = linear(albedo.rgb);
  if (is_backdrop(albedo.a)) return base;
  vec3 here = camera_position(pixel, camera_z(texelFetch(depth_map, q, 0).r));
  vec3 normal = normalize(texelFetch(normal_map, q, 0).xyz * 2.0 - 1.0);
  // Points shade each other only from three radii on, else every sphere has a black side.
  float offset = shadow_offset + (is_point(albedo.a) ? 3.0 * radius : 0.0);
  float facing = dot(normal, key);
  // Wrapped a little past the edge of the light, as scattering inside foam does.
  float direct = max((facing + 0.12) / 1.12, 0.0) * lit(here, normal, offset);
  vec3 sky = mix(vec3(0.15, 0.145, 0.14), vec3(0.27, 0.29, 0.33), 0.5 + 0.5 * dot(normal, up));
  vec3 view = orthographic ? vec3(0.0, 0.0, 1.0) : normalize(-here);
  float shine = pow(max(dot(normal, normalize(key + view)), 0.0), 24.0) * 0.05 * step(0.0, facing);
  vec3 light = vec3(0.76, 0.73, 0.68) * direct * mix(1.0, open, 0.6) + open * (sky + vec3(0.13, 0.14, 0.16) * max(dot(normal, fill), 0.0)) +
               open * vec3(0.16) * max(dot(normal, rim), 0.0);
  vec3 color = tone(base * light + shine * direct);
  if (is_floor(albedo.a)) {
    float gone = smoothstep(0.35, 1.0, length(here - floor_center) / floor_fade);
    color = mix(color, behind, gone);
  }
  return color;
}
void main() {
  ivec2 p = ivec2(gl_FragCoord.xy);
  float open = texelFetch(open_map, p, 0).r;
  vec3 sum = vec3(0.0);
  for (int j = 0; j < samples; ++j)
    for (int i = 0; i < samples; ++i) {
      vec2 pixel = floor(gl_FragCoord.xy) + (vec2(i, j) + 0.5) / float(samples);
      sum += shade(p * samples + ivec2(i, j), pixel, open);
    }
  out_color = vec4(srgb(clamp(sum / float(samples * samples), 0.0, 1.0)), 1.0);
}
)"};
}

}  // namespace lather::render::shaders
