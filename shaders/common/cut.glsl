// A sum of votes, and when it means that the camera was cut.
#ifndef CUT_GLSL
#define CUT_GLSL
#include "denoiser.glsl"

// A tenth found again is no cut: a pan of 90 degrees a second still finds nine tenths.
const int kLostVote = 1, kFoundVote = kLostVote - 10;
const int kMinVotes = 8; // fewer say nothing about the camera

// votes: two's complement.
bool isCut(uint votes) { return g.isCutDetected != 0u && int(votes) >= kMinVotes; }

#endif
