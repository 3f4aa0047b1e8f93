// Counters of atemporal runs; with COUNTERS 0 they compile to nothing.
#pragma once

#include "generated/gpu_interface.glsl"

// Adds to a 64-bit counter kept as two words; the carry follows from the returned old value.
void count(uint counter, uint amount)
{
#if COUNTERS
    if (amount == 0u)
        return;
    uint old = atomicAdd(counters[2u * counter], amount);
    if (old + amount < old)
        atomicAdd(counters[2u * counter + 1u], 1u);
#endif
}

// Takes back what was added before.
void count_off(uint counter, uint amount)
{
#if COUNTERS
    uint old = atomicAdd(counters[2u * counter], 0u - amount);
    if (old < amount)
        atomicAdd(counters[2u * counter + 1u], 0xFFFFFFFFu);
#endif
}
