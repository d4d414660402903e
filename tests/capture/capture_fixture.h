// A small valid capture in a folder of its own, for tests to break.
#pragma once
#include "catch.h"

#include "capture.h"

#include <nlohmann/json.hpp>

#include <functional>
#include <string>

namespace test
{
// A folder under the system's temporary one that goes with the object.
class TempFolder
{
public:
    TempFolder();
    ~TempFolder();
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;
    const std::filesystem::path& path() const { return m_path; }

private:
    std::filesystem::path m_path;
};

constexpr int kWidth = 7;
constexpr int kHeight = 5;

sample::CaptureInfo makeInfo();

// Every channel of a frame (or of a reference) with values that halves hold exactly and that differ by pixel.
sample::Planes makePlanes(bool isReference, float seed = 0.0f);

// Three frames with all layers, frames 1 and 2 with a reference.
void writeCapture(const std::filesystem::path& folder);

// Loads capture.json, lets `change` edit it, and writes it back.
void editJson(const std::filesystem::path& folder, const std::function<void(nlohmann::json&)>& change);

// The text of the FileError that `body` throws; empty when it throws none.
std::string errorOf(const std::function<void()>& body);

// The error of opening the capture and reading every frame and reference of it.
std::string readingError(const std::filesystem::path& folder);
} // namespace test
