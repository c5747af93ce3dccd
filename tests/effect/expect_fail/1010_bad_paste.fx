// expect: 1010_bad_paste.fx(2,9): error TG1010: '##' at an end of macro 'JOIN'
#define JOIN(a) a ##
float JOIN(g);
