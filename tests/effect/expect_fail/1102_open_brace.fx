// expect: 1102_open_brace.fx(3,1): error TG1102: this '{' is never closed
float4 Shade() : SV_Target0
{
    if (true) {
    return 0;
}
