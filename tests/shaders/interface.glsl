// Arguments in, two results out, one invocation each. In HLSL after nrd_frontend.glsl, which maps the keywords.
struct Arguments { vec4 a, b, c, d, e, f, g, h; };
struct Results { vec4 first, second; };
#ifdef __HLSL_VERSION
[[vk::constant_id(0)]] const int kFunction = 0;
[[vk::binding(0, 0)]] StructuredBuffer<Arguments> gArguments;
[[vk::binding(1, 0)]] RWStructuredBuffer<Results> gResults;
mat3 fromColumns(vec3 x, vec3 y, vec3 z) { return transpose(mat3(x, y, z)); }
#else
layout(local_size_x = 64) in;
layout(constant_id = 0) const int kFunction = 0;
layout(set = 0, binding = 0, std430) readonly buffer In { Arguments gArguments[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Out { Results gResults[]; };
mat3 fromColumns(vec3 x, vec3 y, vec3 z) { return mat3(x, y, z); }
#endif

Results results(vec4 first, vec4 second)
{
    Results r;
    r.first = first;
    r.second = second;
    return r;
}
