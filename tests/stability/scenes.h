// Scenes of flat boards, and the cameras that look at them.
#pragma once
#include <setup.h>
#include <vector>

namespace stability
{
// A rectangle, seen from both sides.
struct Board
{
    glm::vec3 centre{0.0f};
    glm::vec3 right{1.0f, 0.0f, 0.0f}, up{0.0f, 1.0f, 0.0f}; // half of the sides, at right angles
    float roughness = 0.7f;
};

quality::Trace traceBoards(std::vector<Board> boards);
quality::Camera lookFrom(glm::vec3 position, glm::vec3 direction);

// The same boards in every frame, or those of a frame.
void showBoards(options::Setup& setup, std::vector<Board> boards);
void showBoards(options::Setup& setup, std::function<std::vector<Board>(int frame)> boards);
} // namespace stability
