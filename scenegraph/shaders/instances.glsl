// instances.glsl: for vertex shaders. Which copy this is; use it in place of gl_InstanceID, which counts from 0 in every
// slice of a drawable (drawable_slices.h). u_first_instance is set by who draws slices alone, and 0 without.
uniform int u_first_instance;
int sfInstance() { return u_first_instance + gl_InstanceID; }
