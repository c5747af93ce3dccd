// expect: 1101_unexpected_token.fx(3,1): error TG1101: expected ',' or ';' after the declaration, found 'float'
float4 gTint = 1
float gScale;
