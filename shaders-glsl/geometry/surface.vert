// Vertices of the scene, for every geometry pass.
//
// VIEWS: how many views are drawn at once, a layer of the target each: then every instance comes as often, view by view. 0
// for one view, whose number is pushed.
// VARYINGS: 0 position alone, 1 with colour and texture coordinates (alpha test), 2 with the normal and tangent.
// MODELS: 1 with the model, which is the instance.
// TEXTURES: those of the material that are sampled; without any there are no texture coordinates, without a normal map no
// tangent.
#version 460
#extension GL_ARB_shader_viewport_layer_array : require
#include "generated/gpu_interface.glsl"
#include "lib/mirror.glsl"
#include "lib/texture_slots.glsl"

layout(location = 0) in vec3 position;
#define TEXTURED (VARYINGS >= 1 && TEXTURES != 0)
#define NORMAL_MAPPED (VARYINGS >= 2 && HAS_TEXTURE(NORMAL))

#if TEXTURED
layout(location = 3) in vec2 uv0;
layout(location = 4) in vec2 uv1;
layout(location = 0) out vec4 out_uv;
#endif
#if VARYINGS >= 1
layout(location = 5) in vec4 color;
layout(location = 1) out vec4 out_color;
#endif
#if NORMAL_MAPPED
layout(location = 2) in vec4 tangent;
layout(location = 3) out vec4 out_tangent;
#endif
#if VARYINGS >= 2
layout(location = 1) in vec3 normal;
layout(location = 2) out vec3 out_normal;
#if VIEWS
layout(location = 4) flat out uint out_view;
#endif
#endif

#if MODELS
layout(location = 5) flat out uint out_model;
#endif

// The same bits in every pass: shading tests for equal depth.
invariant gl_Position;

uint drawn_instance(uint place)
{
#if CULLING == CULLING_GPU
    return drawn_instances[place];
#else
    return place;
#endif
}

mat4 world_from_object_of(uint instance)
{
    return read_instance(instance).world_from_object;
}

void main()
{
#if VIEWS
    uint view = gl_InstanceIndex % VIEWS;
    uint instance = drawn_instance(gl_InstanceIndex / VIEWS);
    gl_Layer = int(view);
#else
    uint view = push.view;
    uint instance = drawn_instance(gl_InstanceIndex);
#endif
    mat4 world_from_object = world_from_object_of(instance);
    vec4 world = world_from_object * vec4(position, 1.0);
    gl_Position = views[view].clip_from_world * world;
    clip_behind_mirror(view, world.xyz);
#if VIEWS
    clip_other_handedness(view);
#endif
#if MODELS
    out_model = instance;
#endif
#if TEXTURED
    out_uv = vec4(uv0, uv1);
#endif
#if VARYINGS >= 1
    out_color = color;
#endif
#if VARYINGS >= 2
    // The cofactor matrix carries normals through any affine map, mirroring included.
    mat3 linear = mat3(world_from_object);
    mat3 cofactor = mat3(cross(linear[1], linear[2]), cross(linear[2], linear[0]), cross(linear[0], linear[1]));
    // Scaled to nothing along one axis it mirrors nothing: the surface is flat, and its normals remain.
    float mirrored = determinant(linear) < 0.0 ? -1.0 : 1.0;
    out_normal = mirrored * (cofactor * normal);
#if VIEWS
    out_view = view;
#endif
#endif
#if NORMAL_MAPPED
    out_tangent = vec4(linear * tangent.xyz, mirrored * tangent.w);
#endif
}
