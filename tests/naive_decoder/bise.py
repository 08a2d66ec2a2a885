"""Bounded integer sequence encoding (section 5.1), by division and modulo of one big integer."""

from integers import ceil_div

# The widths in which a group's values give away the bits of T (BISE-5) or Q (BISE-6).
T_PIECES = (2, 2, 1, 2, 1)
Q_PIECES = (3, 2, 2)


def levels_of(code):
    """The number of levels of a level code (BISE-1)."""
    if code < 3:
        return code + 1
    return (4, 5, 6)[(code - 3) % 3] * 2 ** ((code - 3) // 3)


def least_code(levels):
    """The least level code with at least so many levels."""
    code = 0
    while levels_of(code) < levels:
        code += 1
    return code


def split(levels):
    """(plain bits, number of values of a digit: 1, 3 or 5) of a level count (BISE-2)."""
    plain = 0
    while levels % 2 == 0:
        levels //= 2
        plain += 1
    return plain, levels


def sequence_bits(count, levels):
    """The length of a sequence of `count` values (BISE-3)."""
    plain, digits = split(levels)
    return plain * count + {1: 0, 3: ceil_div(8 * count, 5), 5: ceil_div(7 * count, 3)}[digits]


def bit(word, k):
    """Bit k of a word."""
    return word // 2**k % 2


def bits(word, high, low):
    """Bits high down to low of a word, written word[high:low] in BISE-8."""
    return word // 2**low % 2 ** (high - low + 1)


def trits(T):
    """The five trits of T, t0 first (BISE-8); every T is valid (BISE-10)."""
    if bits(T, 4, 2) == 7:
        C, t4, t3 = bits(T, 7, 5) * 4 + bits(T, 1, 0), 2, 2
    elif bits(T, 6, 5) == 3:
        C, t4, t3 = bits(T, 4, 0), 2, bit(T, 7)
    else:
        C, t4, t3 = bits(T, 4, 0), bit(T, 7), bits(T, 6, 5)
    if bits(C, 1, 0) == 3:
        t2, t1, t0 = 2, bit(C, 4), bit(C, 3) * 2 + bit(C, 2) * (1 - bit(C, 3))
    elif bits(C, 3, 2) == 3:
        t2, t1, t0 = 2, 2, bits(C, 1, 0)
    else:
        t2, t1, t0 = bit(C, 4), bits(C, 3, 2), bit(C, 1) * 2 + bit(C, 0) * (1 - bit(C, 1))
    return [t0, t1, t2, t3, t4]


def quints(Q):
    """The three quints of Q, q0 first (BISE-9); every Q is valid (BISE-10)."""
    if bits(Q, 2, 1) == 3 and bits(Q, 6, 5) == 0:
        without_q0 = 1 - bit(Q, 0)
        return [4, 4, bit(Q, 0) * 4 + bit(Q, 4) * without_q0 * 2 + bit(Q, 3) * without_q0]
    if bits(Q, 2, 1) == 3:
        q2 = 4
        C = bits(Q, 4, 3) * 8 + (1 - bit(Q, 6)) * 4 + (1 - bit(Q, 5)) * 2 + bit(Q, 0)
    else:
        q2, C = bits(Q, 6, 5), bits(Q, 4, 0)
    if bits(C, 2, 0) == 5:
        return [bits(C, 4, 3), 4, q2]
    return [bits(C, 2, 0), bits(C, 4, 3), q2]


def decode(sequence, count, levels):
    """The values of a sequence given as an integer (BISE-2 to BISE-7).

    Bits of the integer at or past sequence_bits(count, levels) are not looked at.
    """
    rest = sequence % 2 ** sequence_bits(count, levels)
    plain, base = split(levels)
    pieces = {1: (0,), 3: T_PIECES, 5: Q_PIECES}[base]
    values = []
    while len(values) < count:
        plain_parts, packed, place = [], 0, 1
        for piece in pieces:
            rest, plain_part = divmod(rest, 2**plain)
            plain_parts.append(plain_part)
            rest, part = divmod(rest, 2**piece)
            packed += part * place
            place *= 2**piece
        digits = {1: lambda _: [0], 3: trits, 5: quints}[base](packed)
        values += [d * 2**plain + m for d, m in zip(digits, plain_parts)]
    return values[:count]


def read(bit_string, position, count, levels):
    """All values of the sequence at a position of a record."""
    return decode(bit_string.field(position, sequence_bits(count, levels)), count, levels)


def read_one(bit_string, position, count, levels, index):
    """Value `index` of the sequence at a position of a record, from its own group alone (BISE-11)."""
    group = len({1: (0,), 3: T_PIECES, 5: Q_PIECES}[split(levels)[1]])
    first = index // group * group
    begin = position + sequence_bits(first, levels)
    return read(bit_string, begin, min(group, count - first), levels)[index - first]
