// The ground: a grid of squares, finer in the middle; slowly varying terms are computed per vertex.
uniform mat4 view_projection;
uniform vec3 centre;             // on the ground, m
uniform float radius;            // of the body, m
uniform float extent;            // half the ground's side, in body radii
uniform vec3 key_direction;
uniform float aspect;            // of the picture

out vec2 v_place;  // in body radii from the centre
out vec3 v_wall;   // the backdrop behind
out vec4 v_light;  // x: key light, y: ambient light, z: fraction of the backdrop, w: strength of the weave

// Gradient of the height of long folds.
vec2 folds(vec2 p) {
  float a = dot(p, vec2(1.9, 0.7)) + 0.8 * sin(dot(p, vec2(0.6, -1.1)));
  float b = dot(p, vec2(-0.8, 2.3)) + 0.9 * sin(dot(p, vec2(1.3, 0.5)) + 1.0);
  return 0.075 * cos(a) * vec2(1.9, 0.7) + 0.055 * cos(b) * vec2(-0.8, 2.3);
}

void main() {
  const int grid = 36;
  int square_index = gl_VertexID / 6, corner = gl_VertexID % 6;
  ivec2 step_out = ivec2(corner == 1 || corner == 3 || corner == 4, corner == 2 || corner == 4 || corner == 5);
  vec2 at = vec2(ivec2(square_index % grid, square_index / grid) + step_out) * (2.0 / float(grid)) - 1.0;
  v_place = extent * at * (0.35 + 0.65 * abs(at));
  gl_Position = view_projection * vec4(centre + radius * vec3(v_place.x, 0.0, v_place.y), 1.0);
  v_wall = backdrop(0.5 + 0.5 * gl_Position.xy / max(gl_Position.w, radius), aspect);
  vec2 slope = folds(v_place);
  float pool = exp(-0.11 * dot(v_place, v_place));
  float facing = clamp(dot(normalize(vec3(-slope.x, 1.0, -slope.y)), key_direction), 0.0, 1.0);
  v_light = vec4(pool * facing, 0.55 * pool, smoothstep(1.6, 5.6, length(v_place)),
                 clamp(1.2 - 0.13 * gl_Position.w / radius, 0.0, 1.0));
}
