// Weights of taps: falloffs, filters of histories, edge stops of the wavelet.
#pragma once
#include "vectors.h"
#include <array>

namespace nrdtest
{
double smooth01(double x);
double soft(double x);  // compact
double heavy(double x); // long-tailed
double ramp(double a, double b, double x);

std::array<double, 4> bilinearWeights(const glm::dvec2& position); // pixels; (0,0) (1,0) (0,1) (1,1)
double customBilinear(const std::array<double, 4>& values, const std::array<double, 4>& weights);

// Without corners, by five bilinear reads: above, left, middle, right, below.
struct CatmullRom
{
    std::array<double, 5> weights;
    glm::dvec2 middle; // pixels
};
CatmullRom catmullRom(const glm::dvec2& position);

double hitDistWeight(double centre, double other, double inverseWidth, double least); // RELAX
double roughnessWeight(double a, double b, double fraction, double sensitivity);
double angleConfidence(double angle, double explained, double forgiven);
double normalCutoff(double roughness, double share, double least); // radians

// What the stops are made of.
struct StopSettings
{
    double lobeAngle, lobeAngleSlack, depthThreshold, roughnessFraction, normalRelaxation, lumaRelaxation;
    double normalDoubt, lumaDoubt, maxLuma, encodingError;
    bool hasRoughnessStop;
};
struct StopInput
{
    double viewZ, roughness, frames, confidence, doubt;
    bool isSpecular;
    int step; // log2 of the stride
};
struct EdgeStops
{
    double normal, roughness, plane; // 1 / radians, 1 / roughness, 1 / world units
    double maxLuma, relax;
};
EdgeStops edgeStops(const StopSettings& settings, const StopInput& in);
double edgeWeight(const EdgeStops& stops, double distance, double angle, double roughnessDifference);
double lumaStop(double centre, double other, double inverseWidth, double cap, double relax);
} // namespace nrdtest
