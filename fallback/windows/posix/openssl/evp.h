// Of OpenSSL what this project uses, by Windows' own cryptography.
#pragma once

#include <stddef.h>

#define EVP_MAX_MD_SIZE 64
inline const void* EVP_sha256() { return nullptr; }
int EVP_Digest(const void* bytes, size_t size, unsigned char* digest, unsigned* digest_size,
               const void* type, void* engine);
/// Base64, and a zero behind it, whose length does not count.
int EVP_EncodeBlock(unsigned char* text, const unsigned char* bytes, int size);
