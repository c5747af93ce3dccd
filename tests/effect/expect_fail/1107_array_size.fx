// expect: 1107_array_size.fx(2,14): error TG1107: an array has 1 to 65536 elements
float4 gTaps[0];
