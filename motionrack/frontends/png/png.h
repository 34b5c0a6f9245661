/* The module that draws an SVG as a PNG: what the program takes from it once a picture is asked for. */
#ifndef MOTIONRACK_PNG_H
#define MOTIONRACK_PNG_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Gives the bytes of a PNG with `scale` pixels to an SVG's px to `take`, and returns 1; or gives the reason, a text,
   and returns 0. `to` goes to `take` as it is. */
__attribute__((visibility("default"))) int motionrack_png_of(const char* svg, size_t size, double scale,
                                                             void (*take)(void* to, const char* bytes, size_t size),
                                                             void* to);

#ifdef __cplusplus
}
#endif

#endif
