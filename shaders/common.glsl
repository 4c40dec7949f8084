// Prepended to every other shader: lights, backdrop, noise, and tone mapping.

const vec3 key_colour = vec3(2.12, 1.99, 1.82);
const vec3 sky_colour = vec3(0.45, 0.51, 0.59);
const vec3 bounce_colour = vec3(0.055, 0.085, 0.09);
const vec3 fill_colour = vec3(0.60, 0.60, 0.61);  // of a lamp at the eye, on what faces down
const vec3 cloth_colour = vec3(0.026, 0.070, 0.084);

// Offset of outline strips towards the eye, in clip depth, so that they lie over adjacent faces.
const float strip_lift = 0.0003;

float square(float x) { return x * x; }

// Filmic curve of Hejl and Burgess-Dawson, which includes the screen's gamma; then dithering by one step against
// banding (interleaved gradient noise, Jimenez 2014).
vec3 to_screen(vec3 radiance, vec2 pixel) {
  vec3 x = max(vec3(0.0), radiance - 0.004);
  vec3 shown = (x * (6.2 * x + 0.5)) / (x * (6.2 * x + 1.7) + 0.06);
  float grain = fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))) - 0.5;
  return shown + grain / 255.0;
}

// The background: a radial glow on a dark wall. at: 0..1 over the picture, y up.
vec3 backdrop(vec2 at, float aspect) {
  vec2 d = (at - vec2(0.5, 0.62)) * vec2(0.62 * aspect, 1.0);
  float glow = 1.0 / (1.0 + 4.0 * dot(d, d));
  return mix(vec3(0.004, 0.006, 0.008), vec3(0.046, 0.064, 0.075), glow * glow);
}

float lattice(vec3 cell) {
  vec3 p = fract(cell * 0.1031);
  p += dot(p, p.zyx + 31.32);
  return fract((p.x + p.y) * p.z);
}

// Value noise with quintic blending. xyz: gradient, w: value in 0..1.
vec4 noise(vec3 p) {
  vec3 i = floor(p), f = p - i;
  vec3 u = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
  vec3 du = 30.0 * f * f * (f * (f - 2.0) + 1.0);
  float a = lattice(i), b = lattice(i + vec3(1, 0, 0)), c = lattice(i + vec3(0, 1, 0)), d = lattice(i + vec3(1, 1, 0));
  float e = lattice(i + vec3(0, 0, 1)), g = lattice(i + vec3(1, 0, 1)), h = lattice(i + vec3(0, 1, 1)),
        j = lattice(i + vec3(1, 1, 1));
  float k1 = b - a, k2 = c - a, k3 = e - a, k4 = a - b - c + d, k5 = a - c - e + h, k6 = a - b - e + g;
  float k7 = -a + b + c - d + e - g - h + j;
  float value = a + k1 * u.x + k2 * u.y + k3 * u.z + k4 * u.x * u.y + k5 * u.y * u.z + k6 * u.z * u.x +
                k7 * u.x * u.y * u.z;
  vec3 slope = du * vec3(k1 + k4 * u.y + k6 * u.z + k7 * u.y * u.z, k2 + k5 * u.z + k4 * u.x + k7 * u.z * u.x,
                         k3 + k6 * u.x + k5 * u.y + k7 * u.x * u.y);
  return vec4(slope, value);
}

// Fraction of a wide lamp that is visible from a place in its shadow map.
float lamp_visibility(sampler2DShadow map, vec3 at) {
  float sum = 0.0;
  for (int i = 0; i < 12; ++i) {  // Vogel's disc
    float angle = 2.39996 * float(i), r = 0.030 * sqrt((float(i) + 0.5) / 12.0);
    sum += texture(map, at + vec3(r * cos(angle), r * sin(angle), 0.0));
  }
  return sum / 12.0;
}
