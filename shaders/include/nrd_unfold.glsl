// Part of nrd_frontend.glsl: include that.
//
// Primary surface replacement: where the camera sees a mirror, the first surface in it that is none takes the mirror's
// place in all inputs, and lies in them where the camera believes it to be: mirrors unfolded, the ray straight.
//
//   NRD_Unfolding now = NRD_Unfolding_Begin(), before = NRD_Unfolding_Begin();
//   for each mirror on the way, the one next to the camera first:
//       now = NRD_Unfolding_AddMirror(now, hit, normal);
//       before = NRD_Unfolding_AddMirror(before, hit + motion, previousNormal); // of the mirror itself
//
// An unfolding moves rigidly, and an odd number of mirrors swaps left and right. Positions are in world space; next to
// its origin they have most digits, so take them relative to the camera where the world is wide.
#ifndef NRD_UNFOLD_GLSL
#define NRD_UNFOLD_GLSL

// From where a surface is to where the camera sees it.
struct NRD_Unfolding
{
    vec3 axisX; // unit: where the world's axes point to
    vec3 axisY;
    vec3 axisZ;
    vec3 offset; // where the world's origin goes to
};

// The camera sees the surface itself: nothing moves.
NRD_Unfolding NRD_Unfolding_Begin()
{
    NRD_Unfolding u;
    u.axisX = vec3(1.0, 0.0, 0.0);
    u.axisY = vec3(0.0, 1.0, 0.0);
    u.axisZ = vec3(0.0, 0.0, 1.0);
    u.offset = vec3(0.0, 0.0, 0.0);
    return u;
}

// Of a normal or any other direction; lengths stay.
vec3 NRD_Unfolding_GetDirection(NRD_Unfolding u, vec3 direction)
{
    return u.axisX * direction.x + u.axisY * direction.y + u.axisZ * direction.z;
}

// IN_VIEWZ is the depth of this; it lies on the camera's ray, as far along it as all parts of the way are long.
vec3 NRD_Unfolding_GetPosition(NRD_Unfolding u, vec3 position)
{
    return u.offset + NRD_Unfolding_GetDirection(u, position);
}

// IN_MV in world space: previous minus current unfolded position. motion: previous minus current position of the
// surface itself. For motion in screen space, project NRD_Unfolding_GetPosition(before, position + motion) instead.
vec3 NRD_Unfolding_GetMotion(NRD_Unfolding now, NRD_Unfolding before, vec3 position, vec3 motion)
{
    // What is alike in both first: with nothing moving, little more than 0 is left.
    vec3 still = (before.offset - now.offset) + (before.axisX - now.axisX) * position.x +
                 (before.axisY - now.axisY) * position.y + (before.axisZ - now.axisZ) * position.z;
    return still + NRD_Unfolding_GetDirection(before, motion);
}

// The ray is reflected at `hit`; the side that the unit normal points to does not matter. A curved mirror is taken for
// its tangent plane: depth and normal are right, motion is that of a plane.
NRD_Unfolding NRD_Unfolding_AddMirror(NRD_Unfolding u, vec3 hit, vec3 normal)
{
    vec3 across = NRD_Unfolding_GetDirection(u, normal) * 2.0;
    NRD_Unfolding next;
    next.axisX = u.axisX - across * normal.x;
    next.axisY = u.axisY - across * normal.y;
    next.axisZ = u.axisZ - across * normal.z;
    next.offset = u.offset + across * dot(normal, hit);
    return next;
}

// The ray is bent at `hit`, from one unit direction to another less than 180 degrees away: glass. Exact for the way of
// this ray; its neighbours are bent a little differently, so that motion is an approximation.
NRD_Unfolding NRD_Unfolding_AddBend(NRD_Unfolding u, vec3 hit, vec3 from, vec3 to)
{
    // The least turn that takes `to` back to `from`, by Rodrigues' formula with its sine in `axis`.
    vec3 axis = cross(to, from);
    float c = dot(to, from);
    float k = 1.0 / max(1.0 + c, 1e-4); // a half turn has no axis
    NRD_Unfolding next;
    next.axisX = NRD_Unfolding_GetDirection(u, vec3(c, axis.z, -axis.y) + axis * (axis.x * k));
    next.axisY = NRD_Unfolding_GetDirection(u, vec3(-axis.z, c, axis.x) + axis * (axis.y * k));
    next.axisZ = NRD_Unfolding_GetDirection(u, vec3(axis.y, -axis.x, c) + axis * (axis.z * k));
    next.offset = NRD_Unfolding_GetPosition(u, hit) - NRD_Unfolding_GetDirection(next, hit);
    return next;
}

#endif
