// Adding to the film, from any invocation to any pixel. Integer atomics: sums do not depend on order.
#ifndef PPM_LIB_FILM_GLSL
#define PPM_LIB_FILM_GLSL

#include "lib/counters.glsl"
#include "shared/film.h"

layout(binding = PPM_BIND_FILM_CONSTANTS, scalar) uniform FilmBlock { FilmConstants film; };
layout(binding = PPM_BIND_FILM_RED, scalar) buffer FilmRed { FilmSum film_red[]; };
layout(binding = PPM_BIND_FILM_GREEN, scalar) buffer FilmGreen { FilmSum film_green[]; };
layout(binding = PPM_BIND_FILM_BLUE, scalar) buffer FilmBlue { FilmSum film_blue[]; };

// Carries by what a word was before: each wrap of a word is seen by exactly one of those who add to it.
#define PPM_ADD_TO_PLANE(plane, pixel, term)                                             \
  {                                                                                      \
    uint low_before = term.low != 0u ? atomicAdd(plane[pixel].low, term.low) : 0u;       \
    uint carry = low_before + term.low < low_before ? 1u : 0u;                           \
    uint high_term = term.high + carry;                                                  \
    uint top_term = term.top + (high_term < carry ? 1u : 0u);                            \
    uint high_before = high_term != 0u ? atomicAdd(plane[pixel].high, high_term) : 0u;   \
    top_term += high_before + high_term < high_before ? 1u : 0u;                         \
    if (top_term != 0u) atomicAdd(plane[pixel].top, top_term);                           \
  }

// Number of the pixel in column x and row y.
uint film_pixel(uvec2 position) { return position.y * film.width + position.x; }

// Adds to a pixel, numbered row by row from the top left. What is not finite is dropped and counted.
void film_add(uint pixel, vec3 radiance) {
  if (!is_finite3(radiance)) {
    count_event(PPM_COUNTER_NON_FINITE);
    return;
  }
  vec3 value = radiance * film.scale;
  if (!(max_component(value) < PPM_FILM_LIMIT)) count_event(PPM_COUNTER_OVERFLOW);
  FilmSum red = to_film_sum(value.x), green = to_film_sum(value.y), blue = to_film_sum(value.z);
  PPM_ADD_TO_PLANE(film_red, pixel, red)
  PPM_ADD_TO_PLANE(film_green, pixel, green)
  PPM_ADD_TO_PLANE(film_blue, pixel, blue)
}

#endif
