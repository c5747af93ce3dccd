// expect: 1003_open_comment.fx(3,5): error TG1003: this comment is never closed; close it with '*/'
float gScale;
    /* this goes on and on
