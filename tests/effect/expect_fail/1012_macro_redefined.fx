// expect: 1012_macro_redefined.fx(3,9): warning TG1012: macro 'SIZE' is defined again, differently
#define SIZE 64
#define SIZE 65
float gSize = SIZE;
