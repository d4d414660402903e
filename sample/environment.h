// Light from infinity: an equirectangular picture with what is needed to sample it by its brightness.
// Direction d is at u = 0.5 + atan2(d.x, -d.z) / 2pi, v = acos(d.y) / pi: the middle of the picture is -Z, its top +Y.
#pragma once
#include "alias_table.h"
#include "image_io.h"

#include <glm/glm.hpp>

namespace sample
{
struct Environment
{
    int width = 0;
    int height = 0;
    std::vector<glm::vec3> radiance;  // per texel, finite and not negative
    std::vector<AliasEntry> alias;    // by luminance times solid angle
    glm::vec3 mean = glm::vec3(0.0f); // over the sphere
};

/// From a picture in linear HDR, at most 8192 wide. Non-finite and negative values become 0.
/// Throws FileError when the picture is empty or too large.
Environment makeEnvironment(const Image& picture);

/// Where the sun of the default sky is: unit, towards it.
extern const glm::vec3 kDefaultSun;

/// The default sky: a gradient with a sun and a grey ground.
Environment makeSky(const glm::vec3& toSun = kDefaultSun);

/// Turned about the vertical by `turns` of the whole circle, to the next texel.
Environment rotated(const Environment& environment, float turns);

/// The same radiance from everywhere.
Environment makeUniformEnvironment(const glm::vec3& radiance);

/// Solid angle of a texel of row `y`, in steradians.
double texelSolidAngle(int width, int height, int y);
} // namespace sample
