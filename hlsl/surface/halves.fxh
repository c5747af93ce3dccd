// A number in two channels of 16 bits whose sum it is, to 2^-21 of it. Graphics hardware filters 16-bit maps everywhere, 32-bit ones not; a
// filter is linear, so the sum of the filtered channels is the filtered number.
#ifndef TEGUMENT_SURFACE_HALVES_FXH
#define TEGUMENT_SURFACE_HALVES_FXH

// step: a power of two, more than |value| / 2048: a half holds its multiples exactly, however it rounds.
float2 tgHalvesOf(float value, float step)
{
    float high = floor(value / step + 0.5) * step;
    return float2(high, value - high);
}

float tgHalvesSum(float2 halves)
{
    return halves.x + halves.y;
}

#endif
// SPDX-License-Identifier: MIT
