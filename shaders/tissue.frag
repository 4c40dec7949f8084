// Wet tissue; with WOUND the raw faces that a cut exposes, or with FIELD the same surface with a colour map; HATCH adds
// stripes where v_beyond > 0; BURNT chars and dries it by v_burnt; PAINTED has colours of its own; OUTLINE draws the
// strip that fades the silhouette.
in vec3 v_normal;
in vec3 v_on_sphere;
in vec3 v_slope;
in vec3 v_view;
in vec3 v_position;
in vec4 v_surface;
in float v_visible;
in float v_value;
#if defined(WOUND) || defined(BURNT)
in vec3 v_rest;
#endif
#ifdef WOUND
in float v_depth;
#endif
#ifdef BURNT
in float v_burnt;
#endif
#ifdef PAINTED
in vec2 v_place;
in vec3 v_colour;
#endif
#ifdef HATCH
in float v_beyond;
#endif
#ifdef OUTLINE
in float v_cover;
#else
const float v_cover = 1.0;
#endif

uniform vec3 key_direction;
uniform vec3 lamp_right, lamp_up;  // the lamp's axes, unit
uniform vec3 rim_direction;
uniform vec3 tool_from, tool_to;   // m, axis of an instrument that casts a fine shadow
uniform float tool_width;          // m; 0: there is none
uniform sampler2D colour_map;
uniform sampler2D detail_map;  // octahedral; rgb: gradient of fine bumps, a: vessels

#ifdef PAINTED
uniform sampler2D paint;
#endif

out vec4 colour;

const float fine_bumps = 0.42;

// Texture coordinates of a direction on the octahedral map.
vec2 octahedral(vec3 d) {
  vec3 p = d / (abs(d.x) + abs(d.y) + abs(d.z));
  vec2 folded = (1.0 - abs(p.yx)) * vec2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
  return 0.5 + 0.5 * (p.z < 0.0 ? folded : p.xy);
}

#ifdef HATCH
uniform float hatch_period;  // pixels

// Cover of diagonal hatching, 0 to 0.8, with soft edges.
float hatching() {
  float across = abs(fract((gl_FragCoord.x + gl_FragCoord.y) / hatch_period) - 0.5) * hatch_period;
  float stripe = 1.0 - smoothstep(0.14 * hatch_period - 0.7, 0.14 * hatch_period + 0.7, across);
  float soft = max(fwidth(v_beyond), 1e-6);
  return 0.8 * stripe * smoothstep(0.0, soft, v_beyond);
}
#endif

// Key light that passes the instrument, 0.3 to 1: by the distance of the ray to the lamp from the instrument's axis.
// The shadow is sharp where the instrument touches the skin and softens with the distance from it.
float past_tool() {
  if (tool_width == 0.0) return 1.0;
  vec3 axis = tool_to - tool_from, w = v_position - tool_from;
  float aa = dot(axis, axis), ak = dot(axis, key_direction), aw = dot(axis, w), kw = dot(key_direction, w);
  float s = clamp((aw - kw * ak) / max(aa - ak * ak, 1e-6 * aa), 0.0, 1.0), t = s * ak - kw;
  if (t < 0.0) return 1.0;
  float edge = tool_width + 0.35 * t;
  float cover = 1.0 - smoothstep(0.0, edge, length(w + t * key_direction - s * axis));
  return 1.0 - 0.7 * cover * sqrt(tool_width / edge);
}

#ifdef WOUND
// Raw tissue by its depth below the skin: the pale capsule, granular tissue under it, darker and bloodier further down;
// vessels that the blade has cut through are dark spots with a pale wall. Returns the colour; slope: of the bumps.
vec3 raw_tissue(vec3 tint, out vec3 slope) {
  vec4 coarse = noise(v_rest * 21.0 + 1.7), fine = noise(v_rest * 83.0);
  slope = 0.26 * coarse.xyz + 0.13 * fine.xyz;
  float capsule = 1.0 - smoothstep(0.4, 1.0, v_depth / (0.008 + 0.005 * coarse.w));
  float deep = smoothstep(0.03, 0.28, v_depth + 0.05 * coarse.w);
  vec3 raw = tint * vec3(0.86, 0.46, 0.48) * (0.74 + 0.52 * fine.w);
  vec3 inner = tint * vec3(0.58, 0.22, 0.28) * (0.70 + 0.60 * coarse.w);
  vec3 result = mix(raw, inner, deep);
  float vessel = smoothstep(0.78, 0.81, coarse.w) * smoothstep(0.02, 0.04, v_depth);
  float lumen = smoothstep(0.83, 0.86, coarse.w);
  result = mix(result, mix(vec3(0.30, 0.10, 0.09), vec3(0.035, 0.002, 0.004), lumen), 0.8 * vessel);
  return mix(result, mix(tint, vec3(0.44, 0.24, 0.20), 0.7), capsule);
}
#endif

#ifdef BURNT
// Tissue that heat has reached: coagulated it is pale, nearer to the electrode brown, and charred along its path, with
// an uneven edge. dry: 1 where it has no gloss and lets no light through; slope: of the crust.
vec3 burnt_tissue(vec3 fresh, out float dry, out vec3 slope) {
  vec4 coarse = noise(v_rest * 19.0 + 9.1), fine = noise(v_rest * 71.0 + 4.3);
  float level = v_burnt + smoothstep(0.0, 0.15, v_burnt) * (0.24 * (coarse.w - 0.5) + 0.12 * (fine.w - 0.5));
  vec3 pale = vec3(0.37, 0.255, 0.175) * (0.84 + 0.32 * fine.w);
  vec3 brown = vec3(0.17, 0.080, 0.034) * (0.60 + 0.80 * fine.w);
  vec3 charred = vec3(0.020, 0.015, 0.012) * (0.50 + 1.00 * fine.w);
  float black = smoothstep(0.70, 0.95, level);
  slope = smoothstep(0.3, 0.9, level) * (0.20 * coarse.xyz + 0.14 * fine.xyz);
  dry = smoothstep(0.02, 0.30, level);
  vec3 result = mix(fresh, pale, 0.88 * smoothstep(0.03, 0.32, level));
  return mix(mix(result, brown, smoothstep(0.38, 0.72, level)), charred, black);
}
#endif

// Environment seen in direction r: a soft box at the key light, a strip light behind, a dim room.
vec3 reflected(vec3 r) {
  float ahead = dot(r, key_direction);
  vec2 box = abs(vec2(dot(r, lamp_right), dot(r, lamp_up)));
  float lamp = (1.0 - smoothstep(0.12, 0.42, box.x)) * (1.0 - smoothstep(0.08, 0.36, box.y)) * step(0.0, ahead);
  float strip = smoothstep(0.80, 0.97, dot(r, rim_direction));
  float room = smoothstep(-0.3, 1.0, r.y);
  return vec3(0.03, 0.05, 0.055) + 0.35 * room * sky_colour + 6.0 * lamp * key_colour + 1.8 * strip * sky_colour;
}

void main() {
#ifdef OUTLINE
  vec3 smooth_n = normalize(v_normal);  // a strip has no front or back
#else
  vec3 smooth_n = normalize(gl_FrontFacing ? v_normal : -v_normal);
#endif
  vec3 v = normalize(v_view);
#ifdef WOUND
  float open = 0.12 + 0.88 * v_value;
  const float fill = 1.0;  // raw tissue is dark
#else
  float open = v_surface.a;
  const float fill = 0.3;
#endif

#ifdef FIELD
  vec3 n = smooth_n, wet_n = smooth_n;
  vec3 albedo = texture(colour_map, vec2(v_value, 0.5)).rgb;
  albedo *= 0.85 * albedo;
  const vec3 wrap = vec3(0.25);
  const float wet = 0.30;
  vec3 hollow = vec3(open);
  vec3 shade = vec3(v_visible);
#elif defined(WOUND)
  vec3 slope;
  vec3 albedo = raw_tissue(v_surface.rgb, slope);
  vec3 tilt = slope - dot(slope, smooth_n) * smooth_n;
  vec3 n = normalize(smooth_n - 0.5 * tilt), wet_n = normalize(smooth_n - 0.8 * tilt);
  const vec3 wrap = vec3(0.40, 0.10, 0.08);
  const float wet = 1.25;
  vec3 hollow = vec3(open, open * open, open * open);
  vec3 shade = vec3(sqrt(v_visible), v_visible, v_visible) * mix(0.25, 1.0, open);
#elif defined(PAINTED)
  // The picture has the colours and details; light and wetness are those of tissue.
  vec3 n = smooth_n, wet_n = smooth_n;
  vec3 painted = v_colour * texture(paint, v_place).rgb;
  vec3 albedo = painted * painted;  // near enough to sRGB's curve
  const vec3 wrap = vec3(0.45, 0.16, 0.12);
  const float wet = 0.8;
  vec3 hollow = vec3(open, open * open, open * open);
  vec3 shade = vec3(sqrt(v_visible), v_visible, v_visible);
#else
  vec4 detail = texture(detail_map, octahedral(v_on_sphere));
  // Bumps: the gradient of a height field over the rest shape, applied to the deformed one. Its rotation is ignored: a
  // random field looks the same either way.
  vec3 slope = v_slope + fine_bumps * open * open * (detail.rgb - 0.5);
  vec3 tilt = slope - dot(slope, smooth_n) * smooth_n;
  vec3 n = normalize(smooth_n - 0.7 * tilt), wet_n = normalize(smooth_n - tilt);
  float blush = min(2.0 * detail.a, 1.0), vessel = max(2.0 * detail.a - 1.0, 0.0);
  vec3 albedo = v_surface.rgb * mix(vec3(1.0), vec3(1.02, 0.72, 0.70), 0.55 * blush);
  albedo *= mix(vec3(1.0), vec3(0.55, 0.25, 0.34), 0.85 * vessel);
  const vec3 wrap = vec3(0.45, 0.16, 0.12);
  const float wet = 1.0;
  vec3 hollow = vec3(open, open * open, open * open);
  vec3 shade = vec3(sqrt(v_visible), v_visible, v_visible);
#endif

#ifdef BURNT
  float dry;
  vec3 crust;
  albedo = burnt_tissue(albedo, dry, crust);
  crust -= dot(crust, smooth_n) * smooth_n;
  n = normalize(n - crust);
  wet_n = normalize(wet_n - crust);
  hollow = mix(hollow, hollow.ggg, dry);
  shade = mix(shade, shade.ggg, dry);
  vec3 bleed = mix(wrap, vec3(0.12), dry);
  float gloss = wet * (1.0 - 0.97 * dry);
#else
  vec3 bleed = wrap;
  float gloss = wet;
#endif

  float past = past_tool();
  shade *= past;
  // Subsurface scattering: wrapped diffuse light, widest in red, whose smooth normal ignores the bumps.
  vec3 facing = vec3(dot(smooth_n, key_direction), vec2(dot(n, key_direction)));
  vec3 lit = clamp((facing + bleed) / (1.0 + bleed), 0.0, 1.0);
  float at_eye = clamp(-smooth_n.y, 0.0, 1.0) * (0.35 + 0.65 * dot(smooth_n, v));
  vec3 below = max(bounce_colour, fill * at_eye * fill_colour);
  vec3 ambient = mix(below, sky_colour, 0.5 + 0.5 * n.y) * hollow;
#ifdef OUTLINE
  float nv = 0.2;  // as in the pixels next to the strip, without the glare at grazing angles
#else
  float nv = clamp(dot(wet_n, v), 0.0, 1.0);
#endif
  float grazing = square(square(1.0 - nv)) * (1.0 - nv);
  float rim = clamp(dot(n, rim_direction) * 0.6 + 0.4, 0.0, 1.0) * square(1.0 - nv);
  vec3 radiance = albedo * (lit * shade * key_colour + ambient + 1.2 * rim * sky_colour);

  float fresnel = 0.03 + 0.55 * grazing;
  float nh = clamp(dot(n, normalize(key_direction + v)), 0.0, 1.0);
  float broad = 0.05 * square(square(square(square(nh)))) * clamp(4.0 * facing.y, 0.0, 1.0) * v_visible * past;
  radiance += gloss * (fresnel * mix(0.35, 1.0, v_visible * past) * open * reflected(reflect(-v, wet_n)) +
                     broad * vec3(1.0, 0.72, 0.66) * key_colour);
  colour = vec4(to_screen(radiance, gl_FragCoord.xy), v_cover);
#ifdef HATCH
#ifdef FIELD
  const vec3 hatch_colour = vec3(0.05, 0.06, 0.07);
#else
  const vec3 hatch_colour = vec3(0.93, 0.76, 0.44);
#endif
  colour.rgb = mix(colour.rgb, hatch_colour, hatching());
#endif
}
