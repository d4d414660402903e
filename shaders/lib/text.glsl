// A bitmap font of 3x5 texels: capitals and digits, enough for labels.
#ifndef TEXT_GLSL
#define TEXT_GLSL

// Octal: one digit per row from the top, its bits from left to right.
const uint kBlank = 000000u;
const uint kA = 025755u, kB = 065656u, kC = 034443u, kD = 065556u, kE = 074647u, kF = 074644u, kG = 034553u;
const uint kH = 055755u, kI = 072227u, kJ = 011152u, kK = 055655u, kL = 044447u, kM = 057755u, kN = 065555u;
const uint kO = 025552u, kP = 065644u, kQ = 025573u, kR = 065655u, kS = 034216u, kT = 072222u, kU = 055557u;
const uint kV = 055552u, kW = 055775u, kX = 055255u, kY = 055222u, kZ = 071247u;
const uint kDigits[10] = uint[](075557u, 026227u, 061247u, 071317u, 055711u,
                                074616u, 034657u, 071122u, 075757u, 075316u);

const ivec2 kGlyphSize = ivec2(3, 5);
const int kAdvance = 4;     // from one glyph to the next
const int kLabelLength = 12; // glyphs, padded with blanks

// p: from the glyph's top left corner, in texels of the font.
bool isGlyphInk(uint glyph, ivec2 p)
{
    bool isInside = all(greaterThanEqual(p, ivec2(0))) && all(lessThan(p, kGlyphSize));
    int bit = 14 - 3 * p.y - p.x;
    return isInside && ((glyph >> uint(clamp(bit, 0, 14))) & 1u) != 0u;
}

int labelLength(uint glyphs[kLabelLength])
{
    int length = kLabelLength;
    while (length > 0 && glyphs[length - 1] == kBlank) length--;
    return length;
}

bool isLabelInk(uint glyphs[kLabelLength], ivec2 p)
{
    int i = clamp(p.x / kAdvance, 0, kLabelLength - 1);
    return p.x >= 0 && isGlyphInk(glyphs[i], p - ivec2(i * kAdvance, 0));
}

// Decimal, from left to right; numbers have up to two digits.
bool isNumberInk(uint number, ivec2 p)
{
    bool hasTens = number >= 10u;
    uint glyph = hasTens && p.x < kAdvance ? kDigits[(number / 10u) % 10u] : kDigits[number % 10u];
    return isGlyphInk(glyph, p - ivec2(hasTens && p.x >= kAdvance ? kAdvance : 0, 0));
}

#endif
