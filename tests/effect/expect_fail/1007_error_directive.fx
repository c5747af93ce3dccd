// expect: 1007_error_directive.fx(3,2): error TG1007: #error define QUALITY first
#ifndef QUALITY
#error define QUALITY first
#endif
