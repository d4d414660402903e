#include "scenes.h"
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <utility>

namespace stability
{
namespace
{
void intersect(const Board& board, glm::vec3 origin, glm::vec3 direction, quality::Hit& hit)
{
    const glm::vec3 normal = glm::normalize(glm::cross(board.right, board.up));
    const float distance = glm::dot(normal, board.centre - origin) / glm::dot(normal, direction);
    if (!(distance > 0.0f && distance < hit.distance)) return; // negated: a ray along the board misses
    const glm::vec3 local = origin + direction * distance - board.centre;
    const bool isInside = std::abs(glm::dot(local, board.right)) <= glm::dot(board.right, board.right) &&
                          std::abs(glm::dot(local, board.up)) <= glm::dot(board.up, board.up);
    if (isInside) hit = {distance, glm::dot(normal, direction) < 0.0f ? normal : -normal, board.roughness};
}
} // namespace

quality::Trace traceBoards(std::vector<Board> boards)
{
    return [boards = std::move(boards)](glm::vec3 origin, glm::vec3 direction)
    {
        quality::Hit hit;
        for (const Board& board : boards) intersect(board, origin, direction, hit);
        return hit;
    };
}

quality::Camera lookFrom(glm::vec3 position, glm::vec3 direction)
{
    quality::Camera camera;
    camera.position = position;
    camera.worldToView = glm::lookAtLH(position, position + direction, {0, 1, 0});
    return camera;
}

void showBoards(options::Setup& setup, std::vector<Board> boards)
{
    showBoards(setup, [boards = std::move(boards)](int) { return boards; });
}

void showBoards(options::Setup& setup, std::function<std::vector<Board>(int frame)> boards)
{
    setup.scene = [boards = std::move(boards)](const quality::Camera& camera, glm::ivec2 size, int frame)
    { return quality::renderGuides(camera, size.x, size.y, traceBoards(boards(frame))); };
}
} // namespace stability
