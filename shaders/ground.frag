// A surgical drape in a spot of light, with the shadows of body and tools, that fades into the backdrop.
in vec2 v_place;
in vec3 v_wall;
in vec4 v_light;

uniform sampler2D footprint;     // r: shadow of the key light, g: proximity of the body
uniform float footprint_extent;  // half the side it covers, in body radii

out vec4 colour;

void main() {
  vec2 shadow = texture(footprint, 0.5 + (0.5 / footprint_extent) * v_place).rg;
  vec2 thread = abs(fract(v_place * 34.0) - 0.5) - 0.25;
  float weave = 1.0 + v_light.w * thread.x * thread.y;
  vec3 shown = (weave * v_light.x * (1.0 - 0.82 * shadow.r)) * (key_colour * cloth_colour) +
               (weave * v_light.y * (1.0 - 0.85 * shadow.g)) * (sky_colour * cloth_colour);
  colour = vec4(to_screen(mix(shown, v_wall, v_light.z), gl_FragCoord.xy), 1.0);
}
