// What is kept of a picture, at the same pixels.
uniform sampler2D kept;
out vec4 colour;

void main() { colour = texelFetch(kept, ivec2(gl_FragCoord.xy), 0); }
