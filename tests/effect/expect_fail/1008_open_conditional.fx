// expect: 1008_open_conditional.fx(3,2): error TG1008: this conditional has no '#endif'
float gScale;
#ifdef FX_SM4
float gMore;
