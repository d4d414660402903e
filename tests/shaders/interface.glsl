// Arguments in, two results out, one invocation each.
layout(local_size_x = 64) in;
layout(constant_id = 0) const int kFunction = 0;
struct Arguments { vec4 a, b, c, d, e, f, g, h; };
struct Results { vec4 first, second; };
layout(set = 0, binding = 0, std430) readonly buffer In { Arguments gArguments[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Out { Results gResults[]; };
