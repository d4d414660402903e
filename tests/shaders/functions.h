// The functions under test, by number: one list for the shaders and for C++.
#ifndef FUNCTIONS_H
#define FUNCTIONS_H

#define FN_PACK_NORMAL 0        // a = normal, roughness; b.x material, b.y normal encoding, b.z roughness encoding
#define FN_UNPACK_NORMAL 1      // a = packed; b as above; second result .x = material
#define FN_YCOCG 2              // a.xyz
#define FN_FROM_YCOCG 3         // a.xyz
#define FN_LOBE_SPREAD 4        // a.x roughness, a.y power
#define FN_NORM_HIT_DIST 5      // a = hitDist, viewZ, roughness; b.xyz = A, B, C
#define FN_HIT_DIST 6           // a = normHitDist, viewZ, roughness; b.xyz = A, B, C
#define FN_PACK_RADIANCE 7      // a = radiance, normHitDist; b.x sanitize
#define FN_UNPACK_RADIANCE 8    // a
#define FN_ENVIRONMENT_TERM 9   // a.xyz F0, a.w NoV, b.x roughness
#define FN_MATERIAL_FACTORS 10  // a.xyz albedo, a.w roughness, b.xyz F0, b.w NoV
#define FN_AVERAGING 11         // a = four specular hit distances
#define FN_PACK_RELAX 12        // a = radiance, hitDist; b.x sanitize -> packed; unpacked again
#define FN_PACK_SH 13           // a = radiance, normHitDist; b.xyz direction, b.w sanitize -> sh0, sh1
#define FN_PACK_DIRECTIONAL 14  // a = direction, normHitDist; b.x sanitize
#define FN_TRIMMING 15          // a.x roughness, b.xyz parameters, a.y geometry term -> factor, compensation
#define FN_TRIMMED_SAMPLE 16    // a.xy random, a.z roughness, a.w factor, b.xyz view
#define FN_STRANDS 17           // a.xyz tangent, a.w pixel size, b.xyz view, b.w thickness -> normal, factor; bitangent
#define FN_PACK_RELAX_SH 18     // a = radiance, hitDist; b.xyz direction, b.w sanitize -> sh0, sh1
#define FN_NORMAL_ROUND_TRIP 19 // as FN_PACK_NORMAL; c.x steps of x, y, z, c.y of w, c.z signed -> unpacked; material

#define FN_FALLOFFS 20            // a.x -> soft, heavy, smooth01
#define FN_RAMP 21                // a.xyz
#define FN_DOMINANT_FACTOR 22     // a.x NoV, a.y roughness
#define FN_DOMINANT_DIRECTION 23  // a.xyz N, a.w roughness, b.xyz V
#define FN_LOBE_TANGENT 24        // a.x roughness, a.y share
#define FN_MIRROR_UV 25           // a.xy
#define FN_VIRTUAL_POSITION 26    // a.xyz X, a.w hitDist, b.xyz N, b.w curvature, c.xyz Xprev, c.w roughness
#define FN_IMAGE_MOTION 34        // a.xyz X, a.w hitDist, b.xyz N, b.w curvature, c.w roughness, d.xyz motion
#define FN_CURVATURE 27           // a.xyz X, b.xyz N, c.xyz other X, d.xyz other N
#define FN_RECONSTRUCT 28         // a.xy uv, a.z viewZ, a.w ortho, b frustum
#define FN_FOOTPRINT 29           // a.xy position -> bilinear weights; second result .xy origin
#define FN_CATMULL_ROM 30         // a.xy position -> position the filter's weights average to; second .x weight sum
#define FN_TANGENT_BASIS 31       // a.xyz -> T; second result B
#define FN_PROJECT 32             // a.xyz position, b..: rows x, y, w of the matrix in b, c, d
#define FN_CUSTOM_BILINEAR 33     // a values, b weights
#define FN_CATMULL_ROM_WEIGHTS 36 // a.xy position -> weights 0 to 3; weight 4, middle position
#define FN_ROUND_TO_HALF 37       // a
#define FN_NORMAL_ANGLE 38        // a.xyz, b.xyz
#define FN_AXIS_CODE 35           // a.xyz axis, a.w error of a read, b.x passes, b.y seed -> what is stored, in steps

// Of a lobe record: a = sh0, b.xyz = sh1.
#define FN_FIRST_OF_RESOLVE 100
#define FN_UNPACK_SH 100          // -> c0, chroma, normHitDist; c1, sharpness
#define FN_UNPACK_DIRECTIONAL 101 // a = direction * n, n -> the same
#define FN_EXTRACT 102            // -> colour; direction
#define FN_ROTATE 103             // c.xyz = angle's cosine, sine, 0 about z -> c1
#define FN_SH_DIFFUSE 104         // c.xyz N
#define FN_SH_SPECULAR 105        // c.xyz N, c.w roughness, d.xyz V
#define FN_SG_DIFFUSE 106         // c.xyz N, c.w roughness, d.xyz V
#define FN_SG_SPECULAR 107        // c.xyz N, c.w roughness, d.xyz V
#define FN_SG_INTEGRAL 108        // a.xyz axis, a.w sharpness; b likewise; c.x amplitude
#define FN_RESTORE_DIFFUSE 109    // c.xyz N, d.xyz reference N
#define FN_RESTORE_SPECULAR 110   // c.xyz N, c.w roughness, d.xyz V, e.xyz reference N
#define FN_CAVITY 111             // c.xyz N, c.w cavity, d.x light's cosine, d.y strength -> shadow, with defaults
#define FN_REJITTER 112           // a diffuse c1, roughness; b specular c1; c V; d = N, viewZ; e to h neighbours' d
#define FN_DOMINANT 113           // c.xyz N, c.w roughness, d.xyz V
#define FN_REFERENCE_NORMAL 114   // c = V, roughness; d = N, viewZ; e to h neighbours' d
#define FN_UNPACK_RELAX_SH 115    // -> c0, chroma, history length; c1, sharpness
// Of an unfolding: a.xyz position, f.xyz direction.
#define FN_UNFOLD 116        // b.xyz hit, c.xyz N of a mirror; d, e of the next -> position; direction
#define FN_UNFOLD_MOTION 117 // and f.xyz motion, g.xyz the first mirror's, h.xyz its N before -> motion
#define FN_UNFOLD_BEND 118   // b.xyz hit, c.xyz from, d.xyz to -> position; direction

#define FN_FIRST_OF_SHADOW 200
#define FN_PENUMBRA 200      // a = hitDist, tangent, distance to light, size; b.xyz colour -> sun, local; packed
#define FN_UNPACK_SHADOW 201 // a -> a.x unpacked; a unpacked
#define FN_MULTI_LIGHT 202   // a = radiance, penumbra, b.xyz visibility; c, d and e, f likewise -> penumbra; packed

// Between SIGMA's passes.
#define FN_FIRST_OF_SHADOW_PACKING 300
#define FN_RADIUS 300 // a.x -> code of 8 bits, decoded, second time round; decoded code a.y
#define FN_DEPTH 301  // a.x -> unpacked
#define FN_ROOTS 302  // a -> a stored in 8 bits each and read again; output's
#define FN_PAST 303   // a = shadow, b.x frames -> shadow; frames

// Of the passes of RELAX, which share REBLUR's. h.w: index of the frame's constants.
#define FN_FIRST_OF_PASSES 400
#define FN_FOLLOW_MOTION 400  // a.xy uv, a.z viewZ, b.xyz X, c.xyz motion -> uv; Xprev
#define FN_REPROJECT 401      // a.xy pixel, a.z viewZ, c.xyz motion -> uv, depth to expect; Xprev
#define FN_DISOCCLUSION 402   // a = NoV, frustum's size, threshold, parallax
#define FN_DEPTH_TEST 403     // a depths, b.x expected, b.y threshold
#define FN_PLANE_DISTANCE 404 // a.xy pixel, a.z viewZ, b.xyz N; c other -> REBLUR's, RELAX's, frustum's size, NoV
#define FN_EDGE_STOPS 405     // a = viewZ, roughness, frames, confidence; b = doubt, is specular, step -> the stops
#define FN_EDGE_WEIGHT 406 // a pixel, viewZ, roughness; b.xyz N; c, d other; e = frames, confidence, doubt, is specular
#define FN_LUMA_STOP 407   // a = centre, other, 1 / width, cap; b.x relax
#define FN_ROUGHNESS_WEIGHT 408 // a = roughness, other, fraction, sensitivity
#define FN_ANGLE_CONFIDENCE 409 // a.xyz, b.xyz normals, c.x explained, c.y forgiven
#define FN_HIT_DIST_WEIGHT 410  // a = centre, other, 1 / width, least
#define FN_SANITIZE 412         // a = radiance, hitDist, b.xyz SH1 -> as denoised; axis
#define FN_NORMAL_CUTOFF 411    // a = roughness, narrowing

#endif
