// Double precision, column-major, column vectors; only what is used.
#pragma once
#include <cmath>
#include <cstddef>

namespace nrd
{
struct Double3
{
    double x = 0.0, y = 0.0, z = 0.0;
};

inline Double3 operator-(const Double3& a, const Double3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Double3 operator-(const Double3& a) { return {-a.x, -a.y, -a.z}; }

struct Double4x4
{
    double m[16] = {};

    double& at(size_t row, size_t column) { return m[column * 4 + row]; }
    double at(size_t row, size_t column) const { return m[column * 4 + row]; }
    Double3 row(size_t i) const { return {at(i, 0), at(i, 1), at(i, 2)}; }
    Double3 translation() const { return {m[12], m[13], m[14]}; }
    void setTranslation(const Double3& t)
    {
        m[12] = t.x;
        m[13] = t.y;
        m[14] = t.z;
    }
};

inline Double4x4 toDouble(const float (&matrix)[16])
{
    Double4x4 result;
    for (size_t i = 0; i < 16; i++) result.m[i] = static_cast<double>(matrix[i]);
    return result;
}

inline Double4x4 operator*(const Double4x4& a, const Double4x4& b)
{
    Double4x4 result;
    for (size_t column = 0; column < 4; column++)
    {
        for (size_t row = 0; row < 4; row++)
        {
            double sum = 0.0;
            for (size_t k = 0; k < 4; k++) sum += a.at(row, k) * b.at(k, column);
            result.at(row, column) = sum;
        }
    }
    return result;
}

// The upper 3x3 only.
inline Double3 rotate(const Double4x4& matrix, const Double3& v)
{
    return {matrix.at(0, 0) * v.x + matrix.at(0, 1) * v.y + matrix.at(0, 2) * v.z,
            matrix.at(1, 0) * v.x + matrix.at(1, 1) * v.y + matrix.at(1, 2) * v.z,
            matrix.at(2, 0) * v.x + matrix.at(2, 1) * v.y + matrix.at(2, 2) * v.z};
}

// Transpose of the upper 3x3, no translation: the inverse of a rotation.
inline Double4x4 transposedRotation(const Double4x4& matrix)
{
    Double4x4 result;
    for (size_t row = 0; row < 3; row++)
    {
        for (size_t column = 0; column < 3; column++) result.at(row, column) = matrix.at(column, row);
    }
    result.m[15] = 1.0;
    return result;
}

// NaN gives 0.
inline double saturate(double x) { return x > 0.0 ? (x < 1.0 ? x : 1.0) : 0.0; }
inline double mix(double a, double b, double t) { return a + (b - a) * t; }
} // namespace nrd
