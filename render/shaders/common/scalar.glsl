// The common subset of GLSL and C++: files that include this one compile as both. In C++ the includer
// (render/shaders/shared.h) has named the same types already.
#ifndef SKYIG_CPP
#define real float
#define rvec2 vec2
#define rvec3 vec3
#define SKYIG_INLINE
#endif
