/* Interface of the module that draws an SVG as a PNG, loaded by the program for the first picture. */
#ifndef MOTIONRACK_PNG_H
#define MOTIONRACK_PNG_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Passes the bytes of a PNG with `scale` pixels per SVG px to `take` and returns 1. On an error, passes the reason as
   text and returns 0. `to` is passed to `take` unchanged. */
__attribute__((visibility("default"))) int motionrack_png_of(const char* svg, size_t size, double scale,
                                                             void (*take)(void* to, const char* bytes, size_t size),
                                                             void* to);

#ifdef __cplusplus
}
#endif

#endif
