using System;

namespace UnityEngine.TestTools
{
    /// On `public IEnumerator M()`: each `yield return null` is one frame.
    [AttributeUsage(AttributeTargets.Method)]
    public class UnityTestAttribute : Attribute { }

    [AttributeUsage(AttributeTargets.Method)]
    public class UnitySetUpAttribute : Attribute { }

    [AttributeUsage(AttributeTargets.Method)]
    public class UnityTearDownAttribute : Attribute { }
}
