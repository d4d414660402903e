// evaluate() for each of the arguments.
#ifdef __HLSL_VERSION
[numthreads(64, 1, 1)] void main(uint3 id : SV_DispatchThreadID)
{
    uint count, stride;
    gArguments.GetDimensions(count, stride);
    if (id.x < count) gResults[id.x] = evaluate(gArguments[id.x]);
}
#else
void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i < uint(gArguments.length())) gResults[i] = evaluate(gArguments[i]);
}
#endif
