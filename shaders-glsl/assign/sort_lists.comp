// Sorts each list by light: by insertion while it is short, else by heap, which needs no memory beside. What was written
// are the numbers of lights, which ascend as the lights do.
#version 460
#include "lib/list_builder.glsl"

layout(local_size_x = ASSIGN_GROUP) in;

const uint SHORT = 32u;

void sort_by_insertion(uint first, uint end)
{
    for (uint i = first + 1u; i < end; ++i) {
        uint light = light_indices[i];
        uint slot = i;
        for (; slot > first; --slot) {
            uint before = light_indices[slot - 1u];
            if (before < light)
                break;
            light_indices[slot] = before;
        }
        light_indices[slot] = light;
    }
}

// Lets the item at `place` of the heap at `first` sink below all that are larger.
void sink(uint first, uint place, uint size)
{
    uint light = light_indices[first + place];
    for (uint child = 2u * place + 1u; child < size; child = 2u * place + 1u) {
        uint largest = light_indices[first + child];
        if (child + 1u < size && light_indices[first + child + 1u] > largest)
            largest = light_indices[first + ++child];
        if (largest < light)
            break;
        light_indices[first + place] = largest;
        place = child;
    }
    light_indices[first + place] = light;
}

void sort_by_heap(uint first, uint size)
{
    for (uint place = size / 2u; place > 0u; --place)
        sink(first, place - 1u, size);
    for (uint last = size - 1u; last > 0u; --last) {
        uint largest = light_indices[first];
        light_indices[first] = light_indices[first + last];
        light_indices[first + last] = largest;
        sink(first, 0u, last);
    }
}

void main()
{
    uint visible = gl_GlobalInvocationID.x;
    if (visible >= state.visible)
        return;
    uint first = min(list_offsets[visible], grid.index_capacity);
    uint end = min(list_offsets[visible + 1u], grid.index_capacity);
    if (end - first <= SHORT)
        sort_by_insertion(first, end);
    else
        sort_by_heap(first, end - first);
    for (uint i = first; i < end; ++i)
        light_indices[i] = light_of_number(light_indices[i]);
}
