"""Checks whether programs can leave state in the JVM that affects later runs."""
import functools
import struct
import zipfile
from collections.abc import Set

ALLOWED = {
    "java/lang/": "Object String CharSequence Comparable Iterable Number Boolean Byte Character Short Integer Long Float Double Void Math StrictMath "
                  "StringBuilder Enum Record Throwable Exception RuntimeException Error IllegalArgumentException IllegalStateException "
                  "IndexOutOfRangeException UnsupportedOperationException NoSuchFieldError ArithmeticException NullPointerException "
                  "ClassCastException AssertionError Cloneable Class",
    "java/lang/invoke/": "LambdaMetafactory StringConcatFactory MethodHandles MethodHandles$Lookup CallSite MethodType MethodHandle",
    "java/util/": "Collection List Set Map Map$Entry Iterator ListIterator Comparator ArrayList LinkedList ArrayDeque PriorityQueue "
                  "LinkedHashMap LinkedHashSet TreeMap TreeSet Arrays Collections Objects Optional NoSuchElementException BitSet "
                  "Deque Queue SortedMap SortedSet",
    "java/util/function/": None,
    "java/nio/": "ByteBuffer ByteOrder",
    "kotlin/": None,
    "org/collektive/": None,
    "it/unibo/collektive/": None,
    "com/google/flatbuffers/": None,
}
"""Classes that keep no state between sessions, by package. None stands for all classes of a package and its subpackages."""
FORBIDDEN_PACKAGES = ("kotlin/concurrent/", "kotlin/io/", "kotlin/jvm/internal/unsafe/", "kotlin/system/",
                      "kotlin/coroutines/", "org/collektive/host/", "org/collektive/engine/")
HASH_ORDER = (b"java/util/HashMap", b"java/util/HashSet")
ALLOWED_OF_CLASS = {"getName", "getSimpleName", "hashCode", "equals", "desiredAssertionStatus", "isInstance", "cast"}
# The sizes of constants in a class file, by tag. Texts are not listed, because their size varies.
SIZES = {3: 4, 4: 4, 5: 8, 6: 8, 7: 2, 8: 2, 9: 4, 10: 4, 11: 4, 12: 4, 15: 3, 16: 2, 17: 4, 18: 4, 19: 2, 20: 2}
TEXT, CLASS, NAME_AND_TYPE = 1, 7, 12
WIDE = (5, 6)
MEMBERS = (9, 10, 11)


@functools.cache
def can_leave_state(jar: str) -> bool:
    """
    Returns whether the programs of a jar refer to a class that may keep state after their session.

    The classes in the jar itself do not count, because each session loads them again. An unreadable jar may keep state.
    """
    try:
        with zipfile.ZipFile(jar) as archive:
            classes = {name.removesuffix(".class"): archive.read(name) for name in archive.namelist() if name.endswith(".class")}
        # The hashes of enums and plain objects, and with them the order of these collections, depend on earlier runs in the process.
        return any(name in content for content in classes.values() for name in HASH_ORDER) or any(
            _can_leave_state(content, classes.keys()) for content in classes.values())
    # An encrypted or damaged entry, or an unknown compression, raises one of many types.
    except Exception:
        return True


def _can_leave_state(content: bytes, own: Set[str]) -> bool:
    constants = _constants(content)

    def text(index: int) -> str:
        return constants[index][1].decode(errors="replace")

    def class_of(index: int) -> str:
        return text(struct.unpack(">H", constants[index][1])[0])

    for tag, value in constants.values():
        if tag == CLASS:
            name = text(struct.unpack(">H", value)[0])
            # The name of an array class contains the type of its elements, which is checked instead.
            name = name.lstrip("[").removeprefix("L").removesuffix(";") if name.startswith("[") else name
            if len(name) > 1 and name not in own and not _is_allowed(name):
                return True
        elif tag in MEMBERS:
            owner, signature = struct.unpack(">HH", value)
            name = text(struct.unpack(">HH", constants[signature][1])[0])
            if class_of(owner) == "java/lang/Class" and name not in ALLOWED_OF_CLASS:
                return True
    return False


def _is_allowed(name: str) -> bool:
    if name.startswith(FORBIDDEN_PACKAGES):
        return False
    for package, names in ALLOWED.items():
        if name.startswith(package) and (names is None or name.removeprefix(package) in names.split()):
            return True
    return False


def _constants(content: bytes) -> dict[int, tuple[int, bytes]]:
    """Returns the constant pool of a class file: the tag and content of each constant by index."""
    count, = struct.unpack_from(">H", content, 8)
    constants: dict[int, tuple[int, bytes]] = {}
    at, index = 10, 1
    while index < count:
        tag = content[at]
        if tag == TEXT:
            size, = struct.unpack_from(">H", content, at + 1)
            constants[index] = tag, content[at + 3:at + 3 + size]
            at += 3 + size
        else:
            constants[index] = tag, content[at + 1:at + 1 + SIZES[tag]]
            at += 1 + SIZES[tag]
        index += 2 if tag in WIDE else 1
    return constants
