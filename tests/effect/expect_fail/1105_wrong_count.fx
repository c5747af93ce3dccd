// expect: 1105_wrong_count.fx(2,16): error TG1105: 2 numbers for float3 that holds 3
float3 gAxis = { 0, 1 };
