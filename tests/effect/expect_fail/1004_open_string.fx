// expect: 1004_open_string.fx(2,32): error TG1004: this string is never closed
float gScale < string UIName = "Scale; >;
