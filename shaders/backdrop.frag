in vec2 v_at;
uniform float aspect;
out vec4 colour;

void main() { colour = vec4(to_screen(backdrop(v_at, aspect), gl_FragCoord.xy), 1.0); }
