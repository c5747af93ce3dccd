// expect: 1010_bad_paste.fx(3,7): error TG1010: 'g' ## '(' in macro 'JOIN' is not one token
#define JOIN(a, b) a ## b
float JOIN(g, (1));
