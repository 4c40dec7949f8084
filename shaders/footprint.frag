// Projection of the body onto the ground. r: shadow of the key light; g: proximity.
in float v_height;
out vec4 colour;

void main() {
  if (v_height < 0.0) discard;  // below the ground
  colour = vec4(1.0, exp(-5.0 * v_height), 0.0, 1.0);
}
