// expect: 2304_no_technique.fx: error TG2304: the effect has no technique
float gScale = 1;
