#include "threaded_engine.h"
#include <algorithm>
#include <thread>

namespace test
{
namespace
{
constexpr uint32_t kRingSize = 4;
}

void ThreadedEngine::run(uint32_t frameNum, const std::function<void(uint32_t)>& set,
                         const std::function<void(uint32_t)>& render)
{
    std::thread renderThread([&] { renderFrames(frameNum, render); });
    std::exception_ptr error;
    try
    {
        for (uint32_t frame = 0; frame < frameNum; frame++)
        {
            {
                std::unique_lock lock(m_mutex);
                m_changed.wait(lock, [&] { return m_setNum - m_renderedNum < kRingSize; });
            }
            set(frame);
            const std::lock_guard lock(m_mutex);
            m_setNum++;
            m_changed.notify_all();
        }
    }
    catch (...) // the render thread must come to its end
    {
        error = std::current_exception();
        const std::lock_guard lock(m_mutex);
        m_setNum = frameNum;
        m_changed.notify_all();
    }
    renderThread.join();
    if (error) std::rethrow_exception(error);
    if (m_error) std::rethrow_exception(m_error);
}

void ThreadedEngine::renderFrames(uint32_t frameNum, const std::function<void(uint32_t)>& render)
{
    for (uint32_t frame = 0; frame < frameNum; frame++)
    {
        const uint32_t ahead = frame % 2 == 0 ? kRingSize : kRingSize - 1;
        {
            std::unique_lock lock(m_mutex);
            m_changed.wait(lock, [&] { return m_setNum >= std::min(frame + ahead, frameNum); });
            m_greatestLag = std::max(m_greatestLag, m_setNum - 1 - frame);
        }
        try
        {
            if (!m_error) render(frame);
        }
        catch (...)
        {
            m_error = std::current_exception();
        }
        const std::lock_guard lock(m_mutex);
        m_renderedNum++;
        m_changed.notify_all();
    }
}
} // namespace test
