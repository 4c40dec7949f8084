// One direction of a separable Gaussian of about three texels; each sample reads two texels by linear filtering.
in vec2 v_at;
uniform sampler2D picture;
uniform vec2 texel;  // one step
out vec4 colour;

void main() {
  colour = 0.1974 * texture(picture, v_at);
  colour += 0.2969 * (texture(picture, v_at + 1.4117 * texel) + texture(picture, v_at - 1.4117 * texel));
  colour += 0.0945 * (texture(picture, v_at + 3.2941 * texel) + texture(picture, v_at - 3.2941 * texel));
  colour += 0.0099 * (texture(picture, v_at + 5.1765 * texel) + texture(picture, v_at - 5.1765 * texel));
}
