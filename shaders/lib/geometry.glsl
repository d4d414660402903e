// Positions, projections, sizes. World positions have their origin at the current camera.
#ifndef GEOMETRY_GLSL
#define GEOMETRY_GLSL
#include "math.glsl"

// frustum: .xy slopes of the top left corner, .zw extent. viewZ > 0.
vec3 reconstructViewPosition(vec2 uv, vec4 frustum, float viewZ, float isOrtho)
{
    vec2 slope = frustum.xy + uv * frustum.zw;
    return vec3(slope * (isOrtho != 0.0 ? 1.0 : viewZ), viewZ);
}

vec3 rotate(mat4 m, vec3 v) { return mat3(m) * v; }

vec3 transform(mat4 m, vec3 p) { return (m * vec4(p, 1.0)).xyz; }

// uv of a world position; (-1, -1), which is off screen, for a point on or behind the camera plane.
vec2 projectToUv(mat4 worldToClip, vec3 position)
{
    vec4 clip = worldToClip * vec4(position, 1.0);
    if (!(clip.w > 1e-9)) return vec2(-1.0);
    return vec2(0.5, -0.5) * (clip.xy / clip.w) + 0.5;
}

bool isInScreen(vec2 uv) { return all(greaterThanEqual(uv, vec2(0.0))) && all(lessThan(uv, vec2(1.0))); }

// Folds a coordinate outside the screen back once, so that kernels at borders do not starve.
vec2 mirrorUv(vec2 uv) { return min(1.0 - abs(1.0 - 2.0 * fract(uv * 0.5)), vec2(0.99999)); }

// World size of one pixel.
float pixelSize(float unproject, float viewZ, float isOrtho) { return unproject * (isOrtho != 0.0 ? 1.0 : viewZ); }

// Tangent of the half angle that holds the given share of a lobe.
float lobeTangent(float roughness, float share)
{
    return saturate(roughness) * sqrt(share / (1.0 - share + kEps));
}

// How much the dominant direction of a specular lobe is the mirror direction: 1 mirror, 0 normal.
float dominantFactor(float NoV, float roughness)
{
    float a = 0.298475 * log(39.4115 - 39.0029 * saturate(roughness));
    return saturate(mix(a, 1.0, pow(saturate(1.0 - NoV), 10.8649)));
}

vec3 dominantDirection(vec3 N, vec3 V, float factor)
{
    return normalize(mix(N, reflect(-V, N), factor));
}

// Half width of a normal's quantisation, radians; index is NormalEncoding.
float normalEncodingError(int encoding)
{
    if (encoding < 2) return 1.5 / 255.0;
    return encoding == 2 ? 0.75 / 255.0 : 0.4 / 255.0;
}

// Tangent-plane basis; Duff et al. 2017, "Building an Orthonormal Basis, Revisited".
void tangentBasis(vec3 N, out vec3 T, out vec3 B)
{
    float s = N.z < 0.0 ? -1.0 : 1.0;
    float a = -1.0 / (s + N.z);
    float b = N.x * N.y * a;
    T = vec3(1.0 + s * N.x * N.x * a, s * b, -s * N.x);
    B = vec3(b, s + N.y * N.y * a, -N.y);
}

#endif
