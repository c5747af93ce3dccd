// expect: 1009_macro_arguments.fx(3,15): error TG1009: macro 'LERP' takes 3 arguments, not 2
#define LERP(a, b, t) ((a) + (t) * ((b) - (a)))
float gHalf = LERP(0, 1);
