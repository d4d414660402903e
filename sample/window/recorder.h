// What leaves the window for the disk: pictures, single images, sequences of pictures, captures.
#pragma once
#include "capture.h"
#include "test_case.h"
#include "window/viewer.h"

namespace sample
{
class Recorder
{
public:
    explicit Recorder(const engine::Device& device) : m_device(device) {}

    /// .png: the picture as it was shown last; .exr: the viewed image in linear light. Throws FileError.
    void savePicture(Viewer& viewer, const std::filesystem::path& file);
    /// All channels of the viewed image as EXR. Throws FileError, also where there is no such image now.
    void saveBuffer(Viewer& viewer, const std::filesystem::path& file);

    /// Every frame that follows; throws FileError.
    void startCapture(Viewer& viewer, const std::filesystem::path& folder);
    void startSequence(const std::filesystem::path& folder);
    void stopCapture(); // writes the head, without which it is none
    void stopSequence() { m_sequence.clear(); }
    /// The scene, the settings of side A and the camera of every frame that follows, as the next numbered test in
    /// `folder`, with a capture of them. Throws FileError.
    void startTest(Viewer& viewer, const std::filesystem::path& folder);
    void stopTest(); // writes it, unless there was no frame
    bool isTesting() const { return !m_testFolder.empty(); }
    bool isCapturing() const { return m_capture.has_value(); }
    bool isSequencing() const { return !m_sequence.empty(); }
    uint32_t capturedFrames() const { return m_captured; }

    /// After each frame that was rendered and shown.
    void addFrame(Viewer& viewer);

private:
    const engine::Device& m_device;
    std::optional<CaptureWriter> m_capture;
    int m_captureWidth = 0, m_captureHeight = 0;
    uint32_t m_captured = 0;
    std::filesystem::path m_sequence;   // empty: none
    std::filesystem::path m_testFolder; // empty: none
    TestCase m_test;
    uint32_t m_sequenced = 0;
};
} // namespace sample
