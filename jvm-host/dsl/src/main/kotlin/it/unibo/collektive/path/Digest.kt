package it.unibo.collektive.path

import java.security.MessageDigest

/** Computes digests of bytes, one after the other. Confined to one thread. */
public interface Digest {
    /** Adds [data] to the input of the next digest. */
    public fun update(data: ByteArray)

    /** Returns the digest of all data since the last call, and resets. */
    public fun digest(): ByteArray

    /** [digest] as text. */
    public fun digestToString(): String
}

/** A digest of the JDK, by default SHA-256; its text is hexadecimal. */
public class JdkDigest(algorithm: String = "SHA-256") : Digest {
    private val backend = MessageDigest.getInstance(algorithm)

    override fun update(data: ByteArray): Unit = backend.update(data)

    override fun digest(): ByteArray = backend.digest()

    override fun digestToString(): String = digest().joinToString("") { "%02x".format(it) }
}
