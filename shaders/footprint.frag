// Projection of the body onto the ground. r: shadow of the key light; g: proximity.
in float v_height;
out vec4 colour;

void main() { colour = vec4(1.0, exp(-5.0 * max(v_height, 0.0)), 0.0, 1.0); }
