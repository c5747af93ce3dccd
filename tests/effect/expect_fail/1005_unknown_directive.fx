// expect: 1005_unknown_directive.fx(2,2): error TG1005: unknown directive '#inlcude'; did you mean 'include'?
#inlcude "a.fxh"
