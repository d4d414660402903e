// An engine's two threads: the main thread sets frames, the render thread renders them up to three frames later.
#pragma once
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>

namespace test
{
class ThreadedEngine
{
public:
    /// `set` runs on the calling thread, `render` on one of its own. In even frames the render thread waits until all
    /// four slots of the ring are taken; in odd ones the main thread may be setting the third frame ahead meanwhile.
    void run(uint32_t frameNum, const std::function<void(uint32_t)>& set, const std::function<void(uint32_t)>& render);
    uint32_t greatestLag() const { return m_greatestLag; } // frames set after the one that was rendered

private:
    void renderFrames(uint32_t frameNum, const std::function<void(uint32_t)>& render);

    std::mutex m_mutex;
    std::condition_variable m_changed;
    uint32_t m_setNum = 0;
    uint32_t m_renderedNum = 0;
    uint32_t m_greatestLag = 0;
    std::exception_ptr m_error; // of the render thread
};
} // namespace test
