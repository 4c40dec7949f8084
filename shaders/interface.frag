in vec2 v_at;
in vec4 v_colour;
uniform sampler2D picture;
out vec4 colour;

void main() { colour = v_colour * texture(picture, v_at); }
